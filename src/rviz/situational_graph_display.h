// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifndef Q_MOC_RUN
#include <OgreAxisAlignedBox.h>
#include <ros/subscriber.h>
#include <rviz/display.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "far_thinning.h"
#include "graph_scene.h"
#include "keyframe_scene.h"
#include "node_fields.h"
#include "scene_objects.h"
#endif

namespace rviz {
class BoolProperty;
class EnumProperty;
class FloatProperty;
class IntProperty;
class Property;
class RosTopicProperty;
}  // namespace rviz

namespace mrpt_sgraphs {

class NodeSelection;

/// rviz's display of a situational graph: its four layers, one above the other, and what ties them
/// together. A node that is clicked on with the Select tool says what it is in the Selection panel.
///
/// Messages are taken apart in rviz's other thread; the newest is drawn, at rviz's own rate.
///
/// Subscribes  graph  (mrpt_sgraphs/SituationalGraph)  in any frame that tf knows
class SituationalGraphDisplay final : public rviz::Display {
  Q_OBJECT

 public:
  SituationalGraphDisplay();
  ~SituationalGraphDisplay() override;

  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;
  void update(float wall_dt_s, float ros_dt_s) override;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private Q_SLOTS:
  void updateTopic();
  void updateOptions();

 private:
  /// What came of a message.
  struct News {
    ShownGraphConstPtr graph;
    std::string problem;  ///< Why there is no graph.
  };

  rviz::BoolProperty* addSwitch(const QString& name, const QString& description,
                                bool SceneOptions::*option, rviz::Property* parent);
  rviz::FloatProperty* addNumber(const QString& name, const QString& description, double value,
                                 double max, rviz::Property* parent);
  void addLayers();
  void addLabels();
  SceneOptions options() const;

  void subscribe();
  void unsubscribe();
  void onGraph(const SituationalGraphConstPtr& msg);
  std::optional<News> takeNews();
  void clear();

  void prepare();
  void draw(const Eye& eye);
  bool placeInFixedFrame();
  std::optional<Eye> eye() const;
  Ogre::AxisAlignedBox boxOf(NodeId node) const;

  rviz::RosTopicProperty* topic_property_;
  rviz::FloatProperty* lift_property_;
  rviz::EnumProperty* colour_property_;
  rviz::FloatProperty* near_property_;
  rviz::IntProperty* thin_above_property_;
  rviz::FloatProperty* wall_alpha_property_;
  rviz::FloatProperty* room_alpha_property_;
  rviz::FloatProperty* label_height_property_;
  std::vector<std::pair<rviz::BoolProperty*, bool SceneOptions::*>> switches_;

  std::shared_ptr<const GraphDrawing> drawing_;
  std::unique_ptr<KeyframeScene> keyframe_scene_;
  std::unique_ptr<NodeSelection> selection_;
  std::unique_ptr<SceneObjects> structure_objects_;
  std::unique_ptr<SceneObjects> keyframe_objects_;
  bool options_changed_ = false;
  std::optional<Eye> drawn_from_;
  double since_drawn_s_ = 0.0;

  std::mutex news_mutex_;  ///< Guards the next one.
  std::optional<News> news_;
  ros::Subscriber graph_sub_;
};

}  // namespace mrpt_sgraphs
