// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifndef Q_MOC_RUN
#include <functional>
#include <memory>

#include "graph_calls.h"
#endif

#include <QObject>
#include <QString>

namespace mrpt_sgraphs {

/// Waits for one call at a time beside the thread of the windows.
class BackgroundCall final : public QObject {
  Q_OBJECT

 public:
  explicit BackgroundCall(QObject* parent);

  /// A call that has not returned goes on, and nobody hears of its answer: it cannot be cut short.
  ~BackgroundCall() override;

  bool isBusy() const { return is_busy_; }

  /// Does nothing while another call is waited for.
  void start(const std::function<CallAnswer()>& call);

 Q_SIGNALS:
  void answered(bool success, const QString& text);

 private Q_SLOTS:
  void finish(bool success, const QString& text);

 private:
  struct Listener;  ///< Shared with the thread that waits.

  std::shared_ptr<Listener> listener_;
  bool is_busy_ = false;
};

}  // namespace mrpt_sgraphs
