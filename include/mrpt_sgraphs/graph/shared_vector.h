// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <atomic>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace mrpt_sgraphs {

/// A vector whose copies share their elements until one of them writes: a copy takes a pointer for
/// each chunk of elements, and a write clones the one chunk that it falls into, if it is shared.
/// Copies may live in different threads; each belongs to one thread at a time.
template <typename T, std::size_t kChunk = 256>
class SharedVector {
 public:
  class const_iterator;
  using value_type = T;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  const T& operator[](std::size_t index) const {
    return (*chunks_[index / kChunk])[index % kChunk];
  }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }
  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, size_}; }

  /// To write; the reference is good until the next copy is taken.
  T& edit(std::size_t index) { return own(index / kChunk)[index % kChunk]; }

  void push_back(T value) {
    if (size_ == kChunk * chunks_.size()) {
      chunks_.push_back(std::make_shared<Chunk>());
      chunks_.back()->reserve(kChunk);
    }
    own(chunks_.size() - 1).push_back(std::move(value));
    ++size_;
  }

  void pop_back() {
    own(chunks_.size() - 1).pop_back();
    --size_;
    if (size_ % kChunk == 0) chunks_.pop_back();
  }

  /// What comes after it moves down by one place, in proportion to how much that is.
  void erase(std::size_t index) {
    for (std::size_t k = index; k + 1 < size_; ++k) edit(k) = (*this)[k + 1];
    pop_back();
  }

  std::size_t chunkCount() const { return chunks_.size(); }

  /// How many chunks are one and the same in both.
  std::size_t chunksSharedWith(const SharedVector& other) const {
    std::size_t shared = 0;
    for (std::size_t k = 0; k < chunks_.size() && k < other.chunks_.size(); ++k) {
      shared += chunks_[k] == other.chunks_[k] ? 1 : 0;
    }
    return shared;
  }

 private:
  using Chunk = std::vector<T>;

  Chunk& own(std::size_t index) {
    std::shared_ptr<Chunk>& chunk = chunks_[index];
    if (chunk.use_count() > 1) {
      const auto clone = std::make_shared<Chunk>();
      clone->reserve(kChunk);
      clone->assign(chunk->begin(), chunk->end());
      chunk = clone;
    } else {
      // what the last other owner read in its thread, it read before we write
      std::atomic_thread_fence(std::memory_order_acquire);
    }
    return *chunk;
  }

  std::vector<std::shared_ptr<Chunk>> chunks_;  ///< All full but the last.
  std::size_t size_ = 0;
};

template <typename T, std::size_t kChunk>
class SharedVector<T, kChunk>::const_iterator {
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = T;
  using difference_type = std::ptrdiff_t;
  using pointer = const T*;
  using reference = const T&;

  const_iterator() = default;
  const_iterator(const SharedVector* vector, std::size_t index) : vector_(vector), index_(index) {}

  reference operator*() const { return (*vector_)[index_]; }
  pointer operator->() const { return &(*vector_)[index_]; }
  reference operator[](difference_type n) const { return *(*this + n); }

  const_iterator& operator+=(difference_type n) {
    index_ = static_cast<std::size_t>(static_cast<difference_type>(index_) + n);
    return *this;
  }
  const_iterator& operator-=(difference_type n) { return *this += -n; }
  const_iterator& operator++() { return *this += 1; }
  const_iterator& operator--() { return *this -= 1; }
  const_iterator operator++(int) { return std::exchange(*this, *this + 1); }
  const_iterator operator--(int) { return std::exchange(*this, *this - 1); }

  friend const_iterator operator+(const_iterator it, difference_type n) { return it += n; }
  friend const_iterator operator+(difference_type n, const_iterator it) { return it += n; }
  friend const_iterator operator-(const_iterator it, difference_type n) { return it -= n; }
  friend difference_type operator-(const_iterator a, const_iterator b) {
    return static_cast<difference_type>(a.index_) - static_cast<difference_type>(b.index_);
  }
  friend bool operator==(const_iterator a, const_iterator b) { return a.index_ == b.index_; }
  friend bool operator!=(const_iterator a, const_iterator b) { return a.index_ != b.index_; }
  friend bool operator<(const_iterator a, const_iterator b) { return a.index_ < b.index_; }
  friend bool operator>(const_iterator a, const_iterator b) { return b < a; }
  friend bool operator<=(const_iterator a, const_iterator b) { return !(b < a); }
  friend bool operator>=(const_iterator a, const_iterator b) { return !(a < b); }

 private:
  const SharedVector* vector_ = nullptr;
  std::size_t index_ = 0;
};

}  // namespace mrpt_sgraphs
