// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "background_call.h"

#include <mutex>
#include <thread>

namespace mrpt_sgraphs {

struct BackgroundCall::Listener {
  std::mutex mutex;
  BackgroundCall* receiver;  ///< Null: gone.
};

BackgroundCall::BackgroundCall(QObject* parent)
    : QObject(parent), listener_(std::make_shared<Listener>()) {
  listener_->receiver = this;
}

BackgroundCall::~BackgroundCall() {
  const std::lock_guard<std::mutex> lock(listener_->mutex);
  listener_->receiver = nullptr;
}

void BackgroundCall::start(const std::function<CallAnswer()>& call) {
  if (is_busy_) return;
  is_busy_ = true;
  // roscpp cannot cut a call short, so nobody may have to wait for this thread; the library is
  // linked never to be unloaded under it
  std::thread([call, listener = listener_] {
    const CallAnswer answer = call();
    const std::lock_guard<std::mutex> lock(listener->mutex);
    if (listener->receiver == nullptr) return;
    QMetaObject::invokeMethod(listener->receiver, "finish", Qt::QueuedConnection,
                              Q_ARG(bool, answer.success),
                              Q_ARG(QString, QString::fromStdString(answer.text)));
  }).detach();
}

void BackgroundCall::finish(bool success, const QString& text) {
  is_busy_ = false;
  answered(success, text);
}

}  // namespace mrpt_sgraphs
