// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifndef Q_MOC_RUN
#include <rviz/panel.h>

#include <functional>
#include <memory>
#include <string>

#include "background_call.h"
#include "graph_feed.h"
#endif

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;
class QTimer;

namespace mrpt_sgraphs {

/// rviz's panel for a GraphSlam: how large the graph is, how long optimizations take, and what can
/// be asked of it. Requests are waited for beside the windows, and their answers are shown.
///
/// Subscribes  see GraphFeed
/// Calls       save_map, dump, optimize, hierarchy/set_parameters
class SituationalGraphPanel final : public rviz::Panel {
  Q_OBJECT

 public:
  explicit SituationalGraphPanel(QWidget* parent = nullptr);

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private Q_SLOTS:
  void listen();
  void refresh();
  void showAnswer(bool success, const QString& text);
  void requestMode(const QString& mode);

 private:
  using Request = std::function<CallAnswer(const std::string& name_space)>;

  QWidget* makeRequests();
  QPushButton* addButton(const QString& text, const QString& hint,
                         const std::function<void()>& on_click);
  void ask(const Request& request);
  void showSizes(const GraphFeed::State& state);
  void showTimes(const OptimizationLog& log);
  void showMode(const std::string& mode);
  /// Without a slash at the end.
  std::string nameSpace() const;

  QLineEdit* name_space_edit_;
  QLabel* sizes_label_;
  QTableWidget* times_table_;
  QComboBox* mode_box_;
  QLineEdit* map_edit_;
  QLineEdit* folder_edit_;
  QWidget* requests_;
  QLabel* answer_label_;
  QTimer* timer_;
  BackgroundCall* call_;
  std::unique_ptr<GraphFeed> feed_;
};

}  // namespace mrpt_sgraphs
