// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace mrpt_sgraphs {

/// Works on a thread of its own, always on the newest of what it was given: what was not begun when
/// something newer comes is skipped. The thread stands back where others want the processor.
template <typename Job>
class NewestWorker {
 public:
  /// @param work  Called on the thread; must not throw.
  explicit NewestWorker(std::function<void(const Job&)> work)
      : work_(std::move(work)), thread_([this] { run(); }) {}

  /// Waits for what is being worked on; what still waits is not done any more.
  ~NewestWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
    }
    something_to_do_.notify_one();
    thread_.join();
  }

  NewestWorker(const NewestWorker&) = delete;
  NewestWorker& operator=(const NewestWorker&) = delete;

  /// Returns at once.
  void put(Job job) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (next_) ++skipped_;
      next_ = std::move(job);
    }
    something_to_do_.notify_one();
  }

  std::size_t skipped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return skipped_;
  }

 private:
  void run() {
    constexpr int kNice = 10;
    constexpr int kThisThread = 0;  // on Linux; elsewhere the process, and then nothing is gained
    setpriority(PRIO_PROCESS, kThisThread, kNice);
    for (;;) {
      std::unique_lock<std::mutex> lock(mutex_);
      something_to_do_.wait(lock, [this] { return stopping_ || next_.has_value(); });
      if (stopping_) return;
      const Job job = std::move(*next_);
      next_.reset();
      lock.unlock();
      work_(job);
    }
  }

  const std::function<void(const Job&)> work_;
  mutable std::mutex mutex_;  ///< Guards the next three.
  std::optional<Job> next_;
  std::size_t skipped_ = 0;
  bool stopping_ = false;
  std::condition_variable something_to_do_;
  std::thread thread_;  ///< Last member: it uses the others.
};

}  // namespace mrpt_sgraphs
