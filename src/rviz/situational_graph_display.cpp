// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "situational_graph_display.h"

#include <OgreCamera.h>
#include <OgreSceneNode.h>
#include <ros/message_traits.h>
#include <ros/node_handle.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <pluginlib/class_list_macros.hpp>

#include "node_selection.h"

namespace mrpt_sgraphs {
namespace {

using rviz::StatusProperty;

constexpr std::uint32_t kQueueSize = 1;  // only the newest is shown
constexpr double kRedrawEvery_s = 0.25;  // while the camera moves

QString counted(std::size_t count, const char* name) {
  return QString::number(count) + " " + name + (count == 1 ? "" : "s");
}

QString sizesOf(const ShownGraph& graph) {
  const auto& keyframes = graph.nodes.keyframes;
  const auto dropped = static_cast<std::size_t>(
      std::count_if(keyframes.begin(), keyframes.end(),
                    [](const KeyframeNode& node) { return node.marginalized; }));
  return counted(keyframes.size(), "keyframe") + " (" + QString::number(dropped) +
         " marginalized), " + counted(graph.nodes.walls.size(), "wall") + ", " +
         counted(graph.nodes.rooms.size(), "room") + ", " +
         counted(graph.nodes.floors.size(), "floor") + ", " +
         counted(graph.msg->factors.size(), "factor");
}

/// Not far enough for it to be drawn in another way.
bool isNear(const Eye& a, const Eye& b) {
  constexpr double kMoved_m = 1.5;
  constexpr double kShare = 0.05;
  return (a.place - b.place).norm() < kMoved_m &&
         std::abs(a.parallel_distance_m - b.parallel_distance_m) <=
             kShare * std::max(a.parallel_distance_m, b.parallel_distance_m);
}

}  // namespace

SituationalGraphDisplay::SituationalGraphDisplay() {
  topic_property_ = new rviz::RosTopicProperty(
      "Topic", "graph", QString::fromStdString(ros::message_traits::datatype<SituationalGraph>()),
      "mrpt_sgraphs/SituationalGraph: what GraphSlam publishes as graph.", this,
      SLOT(updateTopic()));
  colour_property_ = new rviz::EnumProperty("Color By", "Room", "What the colour of a node says.",
                                            this, SLOT(updateOptions()));
  colour_property_->addOption("Layer", static_cast<int>(ColourBy::kLayer));
  colour_property_->addOption("Room", static_cast<int>(ColourBy::kRoom));
  colour_property_->addOption("Floor", static_cast<int>(ColourBy::kFloor));
  colour_property_->addOption("Age", static_cast<int>(ColourBy::kAge));
  const SceneOptions defaults;
  lift_property_ = addNumber("Lift Between Layers",
                             "How far each layer is shown above the one below [m]. 0: in place.",
                             defaults.layer_lift_m, 1000.0, this);
  near_property_ = addNumber("Thin Beyond",
                             "Of keyframes farther from the camera than this [m], one is shown for "
                             "all that are close together, without what they see; walls and rooms "
                             "are outlines there. 0: all is shown.",
                             defaults.near_m, 1e6, this);
  thin_above_property_ =
      new rviz::IntProperty("Thin Above", defaults.thin_above,
                            "Nothing is left out as long as there are no more keyframes than this.",
                            this, SLOT(updateOptions()));
  thin_above_property_->setMin(0);
  addLayers();
  addLabels();
}

SituationalGraphDisplay::~SituationalGraphDisplay() { unsubscribe(); }

rviz::BoolProperty* SituationalGraphDisplay::addSwitch(const QString& name,
                                                       const QString& description,
                                                       bool SceneOptions::*option,
                                                       rviz::Property* parent) {
  auto* const property = new rviz::BoolProperty(name, SceneOptions().*option, description, parent,
                                                SLOT(updateOptions()), this);
  switches_.emplace_back(property, option);
  return property;
}

rviz::FloatProperty* SituationalGraphDisplay::addNumber(const QString& name,
                                                        const QString& description, double value,
                                                        double max, rviz::Property* parent) {
  auto* const property = new rviz::FloatProperty(name, static_cast<float>(value), description,
                                                 parent, SLOT(updateOptions()), this);
  property->setMin(0.0F);
  property->setMax(static_cast<float>(max));
  return property;
}

void SituationalGraphDisplay::addLayers() {
  using Options = SceneOptions;
  const SceneOptions defaults;
  auto* const keyframes =
      addSwitch("Keyframes", "The first layer: where scans were kept.", &Options::keyframes, this);
  addSwitch("Marginalized", "Keyframes that are no longer variables: smaller.",
            &Options::dropped_keyframes, keyframes);
  addSwitch("Odometry", "From keyframe to keyframe, grey.", &Options::odometry, keyframes);
  addSwitch("Loop Closures", "From keyframe to keyframe, red.", &Options::loop_closures, keyframes);
  addSwitch("Condensed Factors",
            "What stands for the factors of marginalized keyframes, violet: from the kept keyframe "
            "of a room to all that it is tied to.",
            &Options::condensed_factors, keyframes);
  addSwitch("Representatives",
            "From each marginalized keyframe to the one that it moves with, thin red.",
            &Options::representatives, keyframes);

  auto* const walls = addSwitch("Walls", "The second layer.", &Options::walls, this);
  wall_alpha_property_ =
      addNumber("Alpha", "How opaque walls are.", defaults.wall_alpha, 1.0, walls);
  addSwitch("Sightings", "From keyframes to the walls that they see.", &Options::wall_sightings,
            walls);
  addSwitch("Backs", "Walls also from behind, where they were not seen from.", &Options::wall_backs,
            walls);
  addSwitch("Two Faces", "Between the two sides of a wall.", &Options::wall_pairs, walls);

  auto* const rooms = addSwitch("Rooms", "The third layer.", &Options::rooms, this);
  room_alpha_property_ =
      addNumber("Alpha", "How opaque the grounds of rooms are.", defaults.room_alpha, 1.0, rooms);
  addSwitch("Walls of Rooms", "From rooms to the walls around them.", &Options::room_walls, rooms);
  addSwitch("Doorways", "From room to room.", &Options::doorways, rooms);

  auto* const floors = addSwitch("Floors", "The fourth layer.", &Options::floors, this);
  addSwitch("Rooms of Floors", "From floors to the rooms on them.", &Options::floor_rooms, floors);
  addSwitch("Stairs", "From floor to floor.", &Options::stairs, floors);
  addSwitch("Ground Sightings", "From keyframes to the floors that they see.",
            &Options::ground_sightings, floors);
}

void SituationalGraphDisplay::addLabels() {
  auto* const labels =
      addSwitch("Labels", "Names of rooms and floors.", &SceneOptions::node_labels, this);
  label_height_property_ =
      addNumber("Size", "Height of a room's label [m]; floors' are larger, the others smaller.",
                SceneOptions().label_height_m, 100.0, labels);
  addSwitch("Wall Ids", "The number of each wall.", &SceneOptions::wall_labels, labels);
  addSwitch("Keyframe Ids", "The numbers of the keyframes next to the camera.",
            &SceneOptions::keyframe_labels, labels);
}

SceneOptions SituationalGraphDisplay::options() const {
  SceneOptions options;
  for (const auto& [property, option] : switches_) options.*option = property->getBool();
  options.colour_by = static_cast<ColourBy>(colour_property_->getOptionInt());
  options.layer_lift_m = lift_property_->getFloat();
  options.near_m = near_property_->getFloat();
  options.thin_above = thin_above_property_->getInt();
  options.wall_alpha = wall_alpha_property_->getFloat();
  options.room_alpha = room_alpha_property_->getFloat();
  options.label_height_m = label_height_property_->getFloat();
  return options;
}

void SituationalGraphDisplay::onInitialize() {
  selection_ = std::make_unique<NodeSelection>(
      context_, NodeSelection::Source{[this](NodeId node) {
                                        return drawing_ ? fieldsOf(*drawing_->graph, node)
                                                        : NodeFields();
                                      },
                                      [this](NodeId node) { return boxOf(node); },
                                      [this](bool by_node) {
                                        structure_objects_->colourByNode(by_node);
                                        keyframe_objects_->colourByNode(by_node);
                                      }});
  const auto makeObjects = [this] {
    return std::make_unique<SceneObjects>(scene_manager_, scene_node_, selection_->getHandle());
  };
  structure_objects_ = makeObjects();
  keyframe_objects_ = makeObjects();
}

void SituationalGraphDisplay::onEnable() { subscribe(); }

void SituationalGraphDisplay::onDisable() {
  unsubscribe();
  clear();
}

/// The topic is latched: who subscribes again is told again.
void SituationalGraphDisplay::reset() {
  Display::reset();
  updateTopic();
}

void SituationalGraphDisplay::setTopic(const QString& topic, const QString& /*datatype*/) {
  topic_property_->setString(topic);
}

void SituationalGraphDisplay::updateTopic() {
  unsubscribe();
  clear();
  subscribe();
}

void SituationalGraphDisplay::updateOptions() { options_changed_ = true; }

void SituationalGraphDisplay::subscribe() {
  if (!isEnabled() || topic_property_->getTopicStd().empty()) return;
  try {
    graph_sub_ = threaded_nh_.subscribe(topic_property_->getTopicStd(), kQueueSize,
                                        &SituationalGraphDisplay::onGraph, this);
    setStatus(StatusProperty::Warn, "Graph", "nothing received yet");
  } catch (const ros::Exception& error) {
    setStatus(StatusProperty::Error, "Graph", QString("cannot subscribe: ") + error.what());
  }
}

void SituationalGraphDisplay::unsubscribe() { graph_sub_.shutdown(); }

/// In rviz's other thread.
void SituationalGraphDisplay::onGraph(const SituationalGraphConstPtr& msg) {
  News news;
  try {
    news.graph = std::make_shared<ShownGraph>(msg);
  } catch (const std::exception& error) {
    news.problem = error.what();
  }
  const std::lock_guard<std::mutex> lock(news_mutex_);
  news_ = std::move(news);
}

std::optional<SituationalGraphDisplay::News> SituationalGraphDisplay::takeNews() {
  const std::lock_guard<std::mutex> lock(news_mutex_);
  std::optional<News> news;
  news.swap(news_);
  return news;
}

void SituationalGraphDisplay::clear() {
  takeNews();
  drawing_.reset();
  keyframe_scene_.reset();
  if (!structure_objects_) return;  // not initialized
  structure_objects_->show(GraphScene());
  keyframe_objects_->show(GraphScene());
  selection_->graphChanged();
}

void SituationalGraphDisplay::update(float wall_dt_s, float /*ros_dt_s*/) {
  since_drawn_s_ += static_cast<double>(wall_dt_s);
  ShownGraphConstPtr graph = drawing_ ? drawing_->graph : nullptr;
  bool is_new = std::exchange(options_changed_, false);
  if (const auto news = takeNews()) {
    if (news->graph) {
      graph = news->graph;
      is_new = true;
    } else {
      setStatusStd(StatusProperty::Error, "Graph", news->problem);
    }
  }
  if (!graph) return;
  if (is_new) {
    drawing_ = std::make_shared<GraphDrawing>(graph, options());
    prepare();
  }
  if (!placeInFixedFrame()) return;
  const std::optional<Eye> eye = this->eye();
  if (!eye) return;
  const bool is_moved =
      drawn_from_ && since_drawn_s_ > kRedrawEvery_s && !isNear(*eye, *drawn_from_);
  if (!drawn_from_ || is_moved) draw(*eye);
  structure_objects_->lookFrom(*eye);
  keyframe_objects_->lookFrom(*eye);
}

void SituationalGraphDisplay::prepare() {
  keyframe_scene_ = std::make_unique<KeyframeScene>(drawing_);
  drawn_from_.reset();
  selection_->graphChanged();
  setStatus(StatusProperty::Ok, "Graph", sizesOf(*drawing_->graph));
}

void SituationalGraphDisplay::draw(const Eye& eye) {
  structure_objects_->show(structureScene(*drawing_, eye), eye);
  keyframe_objects_->show(keyframe_scene_->seenFrom(eye), eye);
  drawn_from_ = eye;
  since_drawn_s_ = 0.0;
  const std::size_t shown = keyframe_scene_->shownCount();
  const std::size_t all = keyframe_scene_->count();
  const QString text = shown == all ? "shown all " + counted(all, "keyframe")
                                    : "shown " + QString::number(shown) + " of " +
                                          counted(all, "keyframe") + " (far ones thinned)";
  setStatus(StatusProperty::Ok, "Keyframes", text);
  setStatus(StatusProperty::Ok, "Far Away",
            drawing_->isThinned() ? "walls and rooms as outlines, no sightings, beyond " +
                                        QString::number(drawing_->options.near_m) + " m"
                                  : QString("nothing is left out"));
  context_->queueRender();
}

/// The graph has no time of its own: it is where its frame is now.
bool SituationalGraphDisplay::placeInFixedFrame() {
  const std::string& frame = drawing_->graph->msg->header.frame_id;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  const bool is_known =
      context_->getFrameManager()->getTransform(frame, ros::Time(), position, orientation);
  scene_node_->setVisible(is_known);
  if (!is_known) {
    setStatusStd(StatusProperty::Error, "Transform",
                 "no transform from " + frame + " to " + fixed_frame_.toStdString());
    return false;
  }
  const bool is_moved = !position.positionEquals(scene_node_->getPosition()) ||
                        !orientation.equals(scene_node_->getOrientation(), Ogre::Radian(1e-5F));
  if (is_moved) {
    scene_node_->setPosition(position);
    scene_node_->setOrientation(orientation);
    selection_->graphChanged();
  }
  deleteStatus("Transform");
  return true;
}

/// In the graph's frame.
std::optional<Eye> SituationalGraphDisplay::eye() const {
  constexpr double kHalfOpening_rad = 0.39;  // of rviz's cameras
  const rviz::ViewController* const view = context_->getViewManager()->getCurrent();
  const Ogre::Camera* const camera = view == nullptr ? nullptr : view->getCamera();
  if (camera == nullptr) return std::nullopt;
  const Ogre::Vector3 place =
      scene_node_->convertWorldToLocalPosition(camera->getDerivedPosition());
  Eye eye;
  eye.place << place.x, place.y, place.z;
  const Ogre::Matrix4& projection = camera->getProjectionMatrix();
  const bool is_parallel = projection[3][3] != 0.0F;
  if (is_parallel) eye.parallel_distance_m = 1.0 / (projection[1][1] * std::tan(kHalfOpening_rad));
  return eye;
}

Ogre::AxisAlignedBox SituationalGraphDisplay::boxOf(NodeId node) const {
  const Eigen::Vector3d* const place = drawing_ ? drawing_->places.find(node) : nullptr;
  if (place == nullptr) return {};
  constexpr double kHalf_m[] = {0.17, 0.15, 0.55, 0.85};  // keyframe, wall, room, floor
  const auto half = static_cast<Ogre::Real>(kHalf_m[static_cast<int>(node.layer)]);
  const Ogre::Vector3 centre =
      scene_node_->getOrientation() * Ogre::Vector3(static_cast<Ogre::Real>(place->x()),
                                                    static_cast<Ogre::Real>(place->y()),
                                                    static_cast<Ogre::Real>(place->z())) +
      scene_node_->getPosition();
  return Ogre::AxisAlignedBox(centre - half, centre + half);
}

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::SituationalGraphDisplay, rviz::Display)
