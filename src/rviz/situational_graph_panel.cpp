// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "situational_graph_panel.h"

#include <ros/names.h>
#include <ros/this_node.h>

#include <QAbstractItemView>
#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <pluginlib/class_list_macros.hpp>

namespace mrpt_sgraphs {
namespace {

constexpr int kRefreshEvery_ms = 300;

/// That rviz itself is in if it is in one, as sgraphs.launch has it; else the usual one.
QString usualNameSpace() {
  const std::string& own = ros::this_node::getNamespace();
  return own.size() > 1 ? QString::fromStdString(own) : QString("/sgraphs");
}

QString milliseconds(double value_ms) { return QString::number(value_ms, 'f', 1); }

}  // namespace

SituationalGraphPanel::SituationalGraphPanel(QWidget* parent)
    : Panel(parent),
      name_space_edit_(new QLineEdit),
      sizes_label_(new QLabel),
      times_table_(new QTableWidget(0, 4)),
      mode_box_(new QComboBox),
      map_edit_(new QLineEdit("map.pcd")),
      folder_edit_(new QLineEdit("sgraphs_run")),
      answer_label_(new QLabel),
      timer_(new QTimer(this)),
      call_(new BackgroundCall(this)) {
  name_space_edit_->setPlaceholderText(usualNameSpace());
  name_space_edit_->setToolTip("Of the GraphSlam that is shown and asked.");
  times_table_->setHorizontalHeaderLabels({"count", "last ms", "mean ms", "max ms"});
  times_table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  times_table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  times_table_->setSelectionMode(QAbstractItemView::NoSelection);
  times_table_->setToolTip("CPU time of the optimizations since this panel listens.");
  answer_label_->setWordWrap(true);
  answer_label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  requests_ = makeRequests();

  auto* const name_space = new QFormLayout;
  name_space->addRow("Namespace", name_space_edit_);
  auto* const column = new QVBoxLayout(this);
  column->addLayout(name_space);
  column->addWidget(sizes_label_);
  column->addWidget(times_table_, 1);
  column->addWidget(requests_);
  column->addWidget(answer_label_);

  connect(name_space_edit_, &QLineEdit::editingFinished, this, &SituationalGraphPanel::listen);
  connect(mode_box_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { requestMode(mode_box_->itemText(index)); });
  connect(call_, &BackgroundCall::answered, this, &SituationalGraphPanel::showAnswer);
  connect(timer_, &QTimer::timeout, this, &SituationalGraphPanel::refresh);
  timer_->start(kRefreshEvery_ms);
  listen();
}

QWidget* SituationalGraphPanel::makeRequests() {
  mode_box_->addItems({"baseline", "paper", "condensed"});
  mode_box_->setCurrentIndex(-1);
  mode_box_->setToolTip("What is optimized, and what becomes of keyframes.");
  map_edit_->setToolTip("File for the map's points, where GraphSlam runs.");
  folder_edit_->setToolTip("Folder for graph, trajectory and map, where GraphSlam runs.");
  // what the fields say is read here: the request itself runs beside the windows
  auto* const optimize =
      addButton("Optimize", "The whole graph, now.", [this] { ask(askToOptimize); });
  auto* const save = addButton("Save map", "Writes the points of the map.", [this] {
    ask([path = map_edit_->text().toStdString()](const std::string& name_space) {
      return askToSaveMap(name_space, path);
    });
  });
  auto* const dump = addButton("Dump", "Writes all of the run.", [this] {
    ask([folder = folder_edit_->text().toStdString()](const std::string& name_space) {
      return askToDump(name_space, folder);
    });
  });

  auto* const widget = new QWidget;
  auto* const grid = new QGridLayout(widget);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->addWidget(new QLabel("Mode"), 0, 0);
  grid->addWidget(mode_box_, 0, 1);
  grid->addWidget(optimize, 0, 2);
  grid->addWidget(map_edit_, 1, 0, 1, 2);
  grid->addWidget(save, 1, 2);
  grid->addWidget(folder_edit_, 2, 0, 1, 2);
  grid->addWidget(dump, 2, 2);
  grid->setColumnStretch(1, 1);
  return widget;
}

QPushButton* SituationalGraphPanel::addButton(const QString& text, const QString& hint,
                                              const std::function<void()>& on_click) {
  auto* const button = new QPushButton(text);
  button->setToolTip(hint);
  connect(button, &QPushButton::clicked, this, on_click);
  return button;
}

std::string SituationalGraphPanel::nameSpace() const {
  const QString text = name_space_edit_->text().trimmed();
  std::string name = (text.isEmpty() ? usualNameSpace() : text).toStdString();
  if (name.front() != '/') name.insert(0, 1, '/');
  while (name.size() > 1 && name.back() == '/') name.pop_back();
  return name == "/" ? "" : name;
}

void SituationalGraphPanel::listen() {
  std::string problem;
  feed_.reset();
  times_table_->setRowCount(0);
  mode_box_->setCurrentIndex(-1);
  if (ros::names::validate(nameSpace(), problem)) {
    feed_ = std::make_unique<GraphFeed>(nameSpace());
  } else {
    showAnswer(false, QString::fromStdString(problem));
  }
  refresh();
  configChanged();
}

void SituationalGraphPanel::refresh() {
  const GraphFeed::State state = feed_ ? feed_->state() : GraphFeed::State();
  showSizes(state);
  showTimes(state.log);
  showMode(state.mode);
}

void SituationalGraphPanel::showSizes(const GraphFeed::State& state) {
  if (!state.sizes) {
    sizes_label_->setText("No graph on " + QString::fromStdString(nameSpace()) + "/graph yet.");
    return;
  }
  const GraphFeed::Sizes& sizes = *state.sizes;
  sizes_label_->setText(
      QString("<b>%1</b> keyframes, and %2 marginalized<br>"
              "<b>%3</b> walls, <b>%4</b> rooms, <b>%5</b> floors<br>"
              "<b>%6</b> factors%7")
          .arg(sizes.active_keyframes)
          .arg(sizes.dropped_keyframes)
          .arg(sizes.walls)
          .arg(sizes.rooms)
          .arg(sizes.floors)
          .arg(sizes.factors)
          .arg(state.last_problem.empty()
                   ? QString()
                   : "<br>" + QString::fromStdString(state.last_problem).toHtmlEscaped()));
}

void SituationalGraphPanel::showTimes(const OptimizationLog& log) {
  times_table_->setRowCount(static_cast<int>(log.byKind().size()));
  int row = 0;
  for (const auto& [kind, times] : log.byKind()) {
    const QStringList cells{QString::number(times.count), milliseconds(times.last_ms),
                            milliseconds(times.mean_ms), milliseconds(times.max_ms)};
    times_table_->setVerticalHeaderItem(row, new QTableWidgetItem(QString::fromStdString(kind)));
    for (int column = 0; column < cells.size(); ++column) {
      auto* const item = new QTableWidgetItem(cells[column]);
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      times_table_->setItem(row, column, item);
    }
    ++row;
  }
}

/// What is in force, unless the user is just asking for something else.
void SituationalGraphPanel::showMode(const std::string& mode) {
  if (call_->isBusy() || mode_box_->view()->isVisible()) return;
  mode_box_->setCurrentIndex(mode_box_->findText(QString::fromStdString(mode)));
}

void SituationalGraphPanel::requestMode(const QString& mode) {
  ask([mode = mode.toStdString()](const std::string& name_space) {
    return askForMode(name_space, mode);
  });
}

void SituationalGraphPanel::ask(const Request& request) {
  requests_->setEnabled(false);
  answer_label_->setStyleSheet(QString());
  answer_label_->setText("...");
  call_->start([request, name_space = nameSpace()] { return request(name_space); });
}

void SituationalGraphPanel::showAnswer(bool success, const QString& text) {
  requests_->setEnabled(true);
  answer_label_->setStyleSheet(success ? "color: #1b7a33;" : "color: #b3261e;");
  answer_label_->setText(text);
}

void SituationalGraphPanel::load(const rviz::Config& config) {
  Panel::load(config);
  const auto read = [&config](const char* key, QLineEdit* edit) {
    QString text;
    if (config.mapGetString(key, &text)) edit->setText(text);
  };
  read("Namespace", name_space_edit_);
  read("Map File", map_edit_);
  read("Run Folder", folder_edit_);
  listen();
}

void SituationalGraphPanel::save(rviz::Config config) const {
  Panel::save(config);
  config.mapSetValue("Namespace", name_space_edit_->text());
  config.mapSetValue("Map File", map_edit_->text());
  config.mapSetValue("Run Folder", folder_edit_->text());
}

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::SituationalGraphPanel, rviz::Panel)
