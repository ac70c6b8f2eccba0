// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scene_objects.h"

#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreResourceGroupManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreTechnique.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <rviz/ogre_helpers/point_cloud.h>
#include <rviz/selection/selection_manager.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace mrpt_sgraphs {
namespace {

constexpr std::uint32_t kIdBits = 22;  // of the 24; the others tell the layer
constexpr std::uint32_t kIdMask = (1U << kIdBits) - 1U;
Ogre::Vector3 toOgre(const Eigen::Vector3f& v) { return Ogre::Vector3(v.x(), v.y(), v.z()); }

Ogre::ColourValue toOgre(const Eigen::Vector3f& rgb, float alpha) {
  return Ogre::ColourValue(rgb[0], rgb[1], rgb[2], alpha);
}

Ogre::ColourValue pickColour(NodeId node) {
  return rviz::SelectionManager::handleToColor(pickIndex(node));
}

/// Unlit, in the colours of its vertices; also in the second pass of picking.
Ogre::MaterialPtr makeMaterial(bool translucent, Ogre::CullingMode culling) {
  static int count = 0;
  Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      "mrpt_sgraphs/situational_graph_" + std::to_string(count++),
      Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->setReceiveShadows(false);
  material->getTechnique(0)->setLightingEnabled(false);
  material->createTechnique()->createPass();
  material->getTechnique(1)->setSchemeName("Pick1");
  material->setCullingMode(culling);
  material->getTechnique(1)->setLightingEnabled(false);
  if (translucent) {
    material->getTechnique(0)->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
    material->getTechnique(0)->setDepthWriteEnabled(false);
  }
  return material;
}

/// Two ribbons at right angles, so that it has a width from wherever it is seen.
void addRibbons(const LineSet::Line& line, float width_m, const Ogre::ColourValue& colour,
                Ogre::uint32 first_vertex, Ogre::ManualObject* object) {
  const Eigen::Vector3f along = (line.to - line.from).normalized();
  const Eigen::Vector3f up = std::abs(along.z()) < 0.9F ? Eigen::Vector3f::UnitZ().eval()
                                                        : Eigen::Vector3f::UnitX().eval();
  const Eigen::Vector3f side = 0.5F * width_m * along.cross(up).normalized();
  const Eigen::Vector3f other_side = along.cross(side);
  for (const Eigen::Vector3f& half : {side, other_side}) {
    const std::array<Eigen::Vector3f, 4> corners{line.from - half, line.from + half, line.to + half,
                                                 line.to - half};
    for (const Eigen::Vector3f& corner : corners) {
      object->position(toOgre(corner));
      object->colour(colour);
    }
    object->quad(first_vertex, first_vertex + 1, first_vertex + 2, first_vertex + 3);
    first_vertex += 4;
  }
}

/// Whether a ribbon would not be wider than the line that is drawn without one, which costs less.
bool isNarrow(const LineSet::Line& line, float width_m, const Eye& eye) {
  constexpr double kNarrow =
      0.0018;  // width over distance: one and a half pixels of a usual window
  const double distance_m =
      std::min(eye.distanceTo(line.from.cast<double>()), eye.distanceTo(line.to.cast<double>()));
  return static_cast<double>(width_m) < kNarrow * distance_m;
}

void fillLines(const LineSet& set, const Eye& eye, const Ogre::MaterialPtr& material,
               Ogre::ManualObject* object) {
  std::vector<LineSet::Line> lines = set.lines;
  const auto narrow = std::stable_partition(lines.begin(), lines.end(), [&](const auto& line) {
    return !isNarrow(line, set.width_m, eye);
  });
  object->clear();
  if (narrow != lines.begin()) {
    object->begin(material->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST);
    Ogre::uint32 vertices = 0;
    for (auto line = lines.begin(); line != narrow; ++line) {
      addRibbons(*line, set.width_m, toOgre(line->rgb, set.alpha), vertices, object);
      vertices += 8;
    }
    object->end();
  }
  if (narrow == lines.end()) return;
  object->begin(material->getName(), Ogre::RenderOperation::OT_LINE_LIST);
  for (auto line = narrow; line != lines.end(); ++line) {
    for (const Eigen::Vector3f& end : {line->from, line->to}) {
      object->position(toOgre(end));
      object->colour(toOgre(line->rgb, set.alpha));
    }
  }
  object->end();
}

void fillArea(const AreaSet& set, bool by_node, const Ogre::MaterialPtr& material,
              Ogre::ManualObject* object) {
  object->clear();
  if (set.triangles.empty()) return;
  object->estimateVertexCount(set.triangles.size() * 3);
  object->begin(material->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST);
  for (const AreaSet::Triangle& triangle : set.triangles) {
    const Ogre::ColourValue colour =
        by_node ? pickColour(triangle.node) : toOgre(triangle.rgb, set.alpha);
    for (const Eigen::Vector3f& corner : triangle.corners) {
      object->position(toOgre(corner));
      object->colour(colour);
    }
  }
  object->end();
}

}  // namespace

std::uint32_t pickIndex(NodeId node) {
  if (node.value >= kIdMask) return 0;
  return static_cast<std::uint32_t>(node.layer) << kIdBits |
         (static_cast<std::uint32_t>(node.value) + 1U);
}

NodeId pickedNode(std::uint32_t index) {
  NodeId node;
  node.layer = static_cast<Layer>(index >> kIdBits & 3U);
  node.value = (index & kIdMask) - 1U;
  return node;
}

SceneObjects::SceneObjects(Ogre::SceneManager* manager, Ogre::SceneNode* parent,
                           rviz::CollObjectHandle handle)
    : manager_(manager),
      node_(parent->createChildSceneNode()),
      handle_(handle),
      opaque_(makeMaterial(false, Ogre::CULL_NONE)),
      translucent_(makeMaterial(true, Ogre::CULL_NONE)),
      opaque_front_(makeMaterial(false, Ogre::CULL_CLOCKWISE)),
      translucent_front_(makeMaterial(true, Ogre::CULL_CLOCKWISE)) {}

SceneObjects::~SceneObjects() {
  show(GraphScene());
  for (Ogre::ManualObject* object : lines_) manager_->destroyManualObject(object);
  for (const Area& area : areas_) {
    manager_->destroyManualObject(area.seen);
    manager_->destroyManualObject(area.picked);
  }
  for (const auto& points : points_) node_->detachObject(points.get());
  manager_->destroySceneNode(node_);
  for (const auto& material : {opaque_, translucent_, opaque_front_, translucent_front_}) {
    Ogre::MaterialManager::getSingleton().remove(material->getHandle());
  }
}

Ogre::ManualObject* SceneObjects::makeObject() {
  Ogre::ManualObject* const object = manager_->createManualObject();
  node_->attachObject(object);
  return object;
}

/// As many as the scene has sets; they stay for later scenes.
void SceneObjects::makeObjects() {
  while (points_.size() < scene_.points.size()) {
    points_.push_back(std::make_unique<rviz::PointCloud>());
    points_.back()->setName("points " + std::to_string(points_.size()));  // told apart by it
    points_.back()->setPickColor(rviz::SelectionManager::handleToColor(handle_));
    node_->attachObject(points_.back().get());
  }
  while (lines_.size() < scene_.lines.size()) lines_.push_back(makeObject());
  while (areas_.size() < scene_.areas.size()) {
    areas_.push_back({makeObject(), manager_->createManualObject()});
  }
}

void SceneObjects::show(GraphScene scene, const Eye& eye) {
  std::swap(scene_, scene);
  makeObjects();
  scene_.points.resize(points_.size());  // what is no longer there is shown empty
  scene_.lines.resize(lines_.size());
  scene_.areas.resize(areas_.size());
  showPoints(false);
  showLines(eye);
  showAreas();
  showLabels();
}

void SceneObjects::colourByNode(bool by_node) {
  showPoints(by_node);
  for (const Area& area : areas_) {
    node_->detachObject(by_node ? area.seen : area.picked);
    node_->attachObject(by_node ? area.picked : area.seen);
  }
}

void SceneObjects::lookFrom(const Eye& eye) {
  constexpr double kReadable = 0.009;  // height over distance: seven pixels of a usual window
  for (std::size_t k = 0; k < label_nodes_.size(); ++k) {
    const Label& label = scene_.labels[k];
    const double distance_m = eye.distanceTo(label.at.cast<double>());
    label_nodes_[k]->setVisible(static_cast<double>(label.height_m) > kReadable * distance_m);
  }
}

void SceneObjects::showPoints(bool by_node) {
  std::vector<rviz::PointCloud::Point> buffer;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const PointSet& set = scene_.points[k];
    rviz::PointCloud& cloud = *points_[k];
    cloud.clear();
    cloud.setRenderMode(rviz::PointCloud::RM_SPHERES);
    cloud.setDimensions(set.size_m, set.size_m, set.size_m);
    buffer.resize(set.points.size());
    for (std::size_t p = 0; p < buffer.size(); ++p) {
      buffer[p].position = toOgre(set.points[p].at);
      buffer[p].color = by_node ? pickColour(set.points[p].node) : toOgre(set.points[p].rgb, 1.0F);
    }
    if (!buffer.empty()) cloud.addPoints(buffer.data(), static_cast<std::uint32_t>(buffer.size()));
  }
}

void SceneObjects::showLines(const Eye& eye) {
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const LineSet& set = scene_.lines[k];
    fillLines(set, eye, set.alpha < 1.0F ? translucent_ : opaque_, lines_[k]);
  }
}

void SceneObjects::showAreas() {
  for (std::size_t k = 0; k < areas_.size(); ++k) {
    const AreaSet& set = scene_.areas[k];
    const Ogre::MaterialPtr& opaque = set.from_both_sides ? opaque_ : opaque_front_;
    const Ogre::MaterialPtr& translucent = set.from_both_sides ? translucent_ : translucent_front_;
    fillArea(set, false, set.alpha < 1.0F ? translucent : opaque, areas_[k].seen);
    fillArea(set, true, opaque, areas_[k].picked);
    rviz::SelectionManager::setPickHandle(handle_, areas_[k].seen);
    rviz::SelectionManager::setPickHandle(handle_, areas_[k].picked);
  }
}

void SceneObjects::showLabels() {
  for (Ogre::SceneNode* node : label_nodes_) {
    node->detachAllObjects();
    manager_->destroySceneNode(node);
  }
  label_nodes_.clear();
  labels_.clear();
  for (const Label& label : scene_.labels) {
    labels_.push_back(std::make_unique<rviz::MovableText>(
        label.text, "Liberation Sans", label.height_m, Ogre::ColourValue(0.1F, 0.1F, 0.1F)));
    labels_.back()->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_ABOVE);
    label_nodes_.push_back(node_->createChildSceneNode(toOgre(label.at)));
    label_nodes_.back()->attachObject(labels_.back().get());
  }
}

}  // namespace mrpt_sgraphs
