// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mrpt_sgraphs {

/// What a program knows, to the last bit, as bytes, and back: so that a run can stop and go on as if
/// it had not. A class says what it is made of once, for both ways:
///
///     template <typename Archive>
///     void archive(Archive& a) {
///       a("way", way_m_);
///       a("newest", newest_);
///     }
///
/// Numbers are little-endian, as on every machine that ROS 1 runs on. What several pointers share is
/// written once and shared again. Each name leaves one byte of itself, so bytes that mean something
/// else are noticed where they begin. Not for exchange: another version of the program may have other
/// members, which is why the file that holds the bytes has a version.

/// Bytes that are not what they should be.
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace archive_detail {

inline uint8_t mark(const char* name) {
  uint32_t hash = 2166136261U;  // FNV-1a
  for (; *name != '\0'; ++name) hash = (hash ^ static_cast<uint8_t>(*name)) * 16777619U;
  return static_cast<uint8_t>(hash ^ (hash >> 8U));
}

template <typename T>
inline constexpr bool kIsNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

}  // namespace archive_detail

class ArchiveWriter {
 public:
  static constexpr bool kReads = false;

  template <typename T>
  void operator()(const char* name, const T& value) {
    bytes_.push_back(static_cast<char>(archive_detail::mark(name)));
    item(value);
  }

  /// Without a name: elements of something.
  template <typename T>
  void item(const T& value) {
    transfer(*this, const_cast<T&>(value));  // a writer changes nothing
  }

  void raw(void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::size_t count(std::size_t size) {
    item(static_cast<uint64_t>(size));
    return size;
  }

  /// Is written by its number from now on. To be told in the same order when it is read.
  void know(const std::shared_ptr<const void>& object) { numberOf(object.get()); }

  template <typename T>
  void shared(std::shared_ptr<const T>& pointer) {
    const auto part = parts_.find(pointer.get());
    if (part != parts_.end()) {
      item(kPart);
      item(part->second.first);
      item(part->second.second);
      return;
    }
    const std::size_t known = numbers_.size();
    const uint64_t number = pointer == nullptr ? 0 : 1 + numberOf(pointer.get());
    item(number);
    if (number <= known) return;
    item(*pointer);
    knowParts(*pointer, number);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr uint64_t kPart = ~uint64_t{0};

  uint64_t numberOf(const void* object) {
    return numbers_.emplace(object, numbers_.size()).first->second;
  }
  template <typename T>
  void knowParts(const T&, uint64_t) {}
  template <typename T>
  void knowParts(const std::vector<T>& list, uint64_t number) {
    if constexpr (std::is_class_v<T>) {
      for (std::size_t k = 0; k < list.size(); ++k) parts_[&list[k]] = {number, uint64_t{k}};
    }
  }

  std::string bytes_;
  std::map<const void*, uint64_t> numbers_;
  std::map<const void*, std::pair<uint64_t, uint64_t>> parts_;  ///< List, place.
};

class ArchiveReader {
 public:
  static constexpr bool kReads = true;

  /// @param bytes  Kept by reference.
  explicit ArchiveReader(const std::string& bytes) : bytes_(bytes) {}

  /// @throws ArchiveError for bytes that are not this, naming the place; as all that reads.
  template <typename T>
  void operator()(const char* name, T& value) {
    path_.push_back({name, -1});
    uint8_t mark = 0;
    raw(&mark, 1);
    if (mark != archive_detail::mark(name)) fail("something else begins here");
    item(value);
    path_.pop_back();
  }

  template <typename T>
  void item(T& value) {
    if (!path_.empty()) ++path_.back().second;
    transfer(*this, value);
  }

  void raw(void* data, std::size_t size) {
    if (size > bytes_.size() - at_) fail("the bytes end here");
    std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }

  /// Of something that has so many elements, each of a byte at least.
  std::size_t count(std::size_t) {
    uint64_t size = 0;
    raw(&size, sizeof size);
    if (size > bytes_.size() - at_) fail("there cannot be " + std::to_string(size) + " of it");
    return static_cast<std::size_t>(size);
  }

  void know(const std::shared_ptr<const void>& object) { objects_.push_back(object); }

  template <typename T>
  void shared(std::shared_ptr<const T>& pointer) {
    uint64_t number = 0;
    raw(&number, sizeof number);
    if (number == kPart) {
      readPart(pointer);
    } else if (number == 0) {
      pointer.reset();
    } else if (number <= objects_.size()) {
      pointer = std::static_pointer_cast<const T>(objects_[number - 1]);
    } else if (number == objects_.size() + 1) {
      const auto made = std::make_shared<T>();
      pointer = made;
      objects_.push_back(pointer);
      item(*made);
    } else {
      fail("a pointer to what has not come yet");
    }
  }

  /// @throws ArchiveError if bytes are left.
  void finish() {
    if (at_ != bytes_.size()) fail("more bytes than there should be");
  }

  [[noreturn]] void fail(const std::string& what) const {
    std::string place;
    for (const auto& [name, index] : path_) {
      place += (place.empty() ? "" : ".") + std::string(name);
      if (index > 0) place += "[" + std::to_string(index - 1) + "]";
    }
    throw ArchiveError("byte " + std::to_string(at_) + (place.empty() ? "" : " (" + place + ")") +
                       ": " + what);
  }

 private:
  static constexpr uint64_t kPart = ~uint64_t{0};

  template <typename T>
  void readPart(std::shared_ptr<const T>& pointer) {
    uint64_t number = 0;
    uint64_t place = 0;
    raw(&number, sizeof number);
    raw(&place, sizeof place);
    if (number == 0 || number > objects_.size()) fail("a part of what has not come yet");
    const auto list = std::static_pointer_cast<const std::vector<T>>(objects_[number - 1]);
    if (place >= list->size()) fail("a part that is not there");
    pointer = std::shared_ptr<const T>(list, &(*list)[place]);
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
  std::vector<std::pair<const char*, long>> path_;
  std::vector<std::shared_ptr<const void>> objects_;
};

template <typename Archive, typename T>
void transfer(Archive& a, T& value);

namespace archive_detail {

/// Elements one after the other.
template <typename Archive, typename List>
void transferList(Archive& a, List& list) {
  const std::size_t size = a.count(list.size());
  if constexpr (Archive::kReads) list = List(size);
  for (auto& element : list) a.item(element);
}

template <typename Archive, typename Map>
void transferMap(Archive& a, Map& map) {
  const std::size_t size = a.count(map.size());
  if constexpr (Archive::kReads) {
    map.clear();
    for (std::size_t k = 0; k < size; ++k) {
      typename Map::key_type key{};
      a.item(key);
      a.item(map[key]);
    }
  } else {
    for (auto& [key, value] : map) {
      a.item(key);
      a.item(value);
    }
  }
}

template <typename Archive, typename T>
void part(Archive& a, std::vector<T>& list) {
  transferList(a, list);
}
template <typename Archive>
void part(Archive& a, std::vector<bool>& list) {
  std::vector<uint8_t> bytes(list.begin(), list.end());
  transferList(a, bytes);
  list.assign(bytes.begin(), bytes.end());
}
template <typename Archive, typename T>
void part(Archive& a, std::deque<T>& list) {
  transferList(a, list);
}
template <typename Archive>
void part(Archive& a, std::string& text) {
  text.resize(a.count(text.size()));
  a.raw(&text[0], text.size());
}
template <typename Archive, typename T, std::size_t N>
void part(Archive& a, std::array<T, N>& list) {
  for (T& element : list) a.item(element);
}
template <typename Archive, typename A, typename B>
void part(Archive& a, std::pair<A, B>& pair) {
  a.item(pair.first);
  a.item(pair.second);
}
template <typename Archive, typename T>
void part(Archive& a, std::optional<T>& optional) {
  bool has = optional.has_value();
  a.item(has);
  if constexpr (Archive::kReads) {
    optional.reset();
    if (has) optional.emplace();
  }
  if (has) a.item(*optional);
}
template <typename Archive, typename K, typename V>
void part(Archive& a, std::map<K, V>& map) {
  transferMap(a, map);
}
template <typename Archive, typename K>
void part(Archive& a, std::set<K>& set) {
  std::vector<K> list(set.begin(), set.end());
  transferList(a, list);
  set = std::set<K>(list.begin(), list.end());
}
/// Sorted: the same content is the same bytes. Whoever goes through one must not depend on its order.
template <typename Archive, typename K, typename V, typename Hash>
void part(Archive& a, std::unordered_map<K, V, Hash>& map) {
  if constexpr (Archive::kReads) {
    transferMap(a, map);
  } else {
    std::map<K, V*> sorted;
    for (auto& [key, value] : map) sorted[key] = &value;
    a.count(map.size());
    for (auto& [key, value] : sorted) {
      a.item(key);
      a.item(*value);
    }
  }
}
template <typename Archive, typename T>
void part(Archive& a, std::shared_ptr<const T>& pointer) {
  a.shared(pointer);
}
template <typename Archive, int Rows, int Columns>
void part(Archive& a, Eigen::Matrix<double, Rows, Columns>& matrix) {
  if constexpr (Rows == Eigen::Dynamic || Columns == Eigen::Dynamic) {
    const std::size_t rows = a.count(static_cast<std::size_t>(matrix.rows()));
    const std::size_t columns = a.count(static_cast<std::size_t>(matrix.cols()));
    matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  }
  a.raw(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
}
template <typename Archive>
void part(Archive& a, Eigen::Isometry3d& T) {
  a.raw(T.matrix().data(), 16 * sizeof(double));
}
template <typename Archive>
void part(Archive& a, Eigen::AlignedBox3d& box) {
  part(a, box.min());
  part(a, box.max());
}

template <typename Archive, typename T, typename = void>
struct HasMember : std::false_type {};
template <typename Archive, typename T>
struct HasMember<Archive, T,
                 std::void_t<decltype(std::declval<T&>().archive(std::declval<Archive&>()))>>
    : std::true_type {};

}  // namespace archive_detail

template <typename Archive, typename T>
void transfer(Archive& a, T& value) {
  if constexpr (archive_detail::HasMember<Archive, T>::value) {
    value.archive(a);
  } else if constexpr (archive_detail::kIsNumber<T>) {
    a.raw(&value, sizeof value);
  } else {
    using archive_detail::part;
    part(a, value);
  }
}

}  // namespace mrpt_sgraphs
