// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "job_thread.h"

#include <exception>
#include <utility>

namespace mrpt_sgraphs {

JobThread::JobThread(std::function<void(const std::string&)> on_problem)
    : on_problem_(std::move(on_problem)), thread_([this] { run(); }) {}

JobThread::~JobThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  something_to_do_.notify_one();
  thread_.join();
}

void JobThread::post(Job job) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  something_to_do_.notify_one();
}

std::size_t JobThread::waiting() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return jobs_.size();
}

void JobThread::run() {
  for (;;) {
    std::unique_lock<std::mutex> lock(mutex_);
    something_to_do_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
    if (stopping_) return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    try {
      job();
    } catch (const std::exception& error) {
      on_problem_(error.what());
    }
  }
}

}  // namespace mrpt_sgraphs
