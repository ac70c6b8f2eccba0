// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace mrpt_sgraphs {

/// A thread that does what it is given in the order in which it came, so that whoever gives it returns
/// at once.
class JobThread {
 public:
  using Job = std::function<void()>;

  /// @param on_problem  Called on the thread with what a job throws.
  explicit JobThread(std::function<void(const std::string&)> on_problem);
  ~JobThread();  ///< What still waits is not done any more.

  void post(Job job);

  /// What the job throws comes with the future.
  template <typename Result>
  std::future<Result> ask(std::function<Result()> job) {
    const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(job));
    post([task] { (*task)(); });
    return task->get_future();
  }

  /// Jobs that wait.
  std::size_t waiting() const;

 private:
  void run();

  const std::function<void(const std::string&)> on_problem_;
  mutable std::mutex mutex_;  ///< Guards the next two.
  std::deque<Job> jobs_;
  bool stopping_ = false;
  std::condition_variable something_to_do_;
  std::thread thread_;  ///< Last member: it uses the others.
};

}  // namespace mrpt_sgraphs
