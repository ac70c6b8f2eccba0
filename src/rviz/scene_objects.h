// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreMaterial.h>
#include <OgrePrerequisites.h>
#include <rviz/selection/forwards.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "far_thinning.h"
#include "graph_scene.h"

namespace rviz {
class MovableText;
class PointCloud;
}  // namespace rviz

namespace mrpt_sgraphs {

/// A node as the 24 bits of a colour, which is how rviz tells what was clicked on; never 0. 0 for
/// an id that is too large for it.
std::uint32_t pickIndex(NodeId node);
NodeId pickedNode(std::uint32_t index);

/// A scene as objects of rviz's renderer.
class SceneObjects {
 public:
  /// @param parent  Its frame is `map`.
  /// @param handle  Of what is picked when something here is clicked on.
  SceneObjects(Ogre::SceneManager* manager, Ogre::SceneNode* parent, rviz::CollObjectHandle handle);
  ~SceneObjects();

  SceneObjects(const SceneObjects&) = delete;
  SceneObjects& operator=(const SceneObjects&) = delete;

  /// As it is seen from the eye: lines that are narrow from there are drawn as such.
  void show(GraphScene scene, const Eye& eye = {});

  /// Leaves out the labels that are too small to be read from there.
  void lookFrom(const Eye& eye);

  /// Each node in the colour of its pickIndex, for rviz's second look at what was clicked on.
  void colourByNode(bool by_node);

 private:
  struct Area {
    Ogre::ManualObject* seen;
    Ogre::ManualObject* picked;  ///< The same in the colours of its nodes. Who shows a branch of
                                 ///< the scene shows all that is attached to it: this one is not.
  };

  void makeObjects();
  Ogre::ManualObject* makeObject();
  void showPoints(bool by_node);
  void showLines(const Eye& eye);
  void showAreas();
  void showLabels();

  Ogre::SceneManager* const manager_;
  Ogre::SceneNode* const node_;
  const rviz::CollObjectHandle handle_;
  Ogre::MaterialPtr opaque_;
  Ogre::MaterialPtr translucent_;
  Ogre::MaterialPtr opaque_front_;  ///< Nothing is seen of it from behind, as of the next one.
  Ogre::MaterialPtr translucent_front_;
  GraphScene scene_;
  std::vector<std::unique_ptr<rviz::PointCloud>> points_;
  std::vector<Ogre::ManualObject*> lines_;  ///< Those of the manager.
  std::vector<Area> areas_;
  std::vector<std::unique_ptr<rviz::MovableText>> labels_;
  std::vector<Ogre::SceneNode*> label_nodes_;
};

}  // namespace mrpt_sgraphs
