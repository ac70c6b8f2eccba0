// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreAxisAlignedBox.h>
#include <rviz/selection/selection_handler.h>

#include <cstdint>
#include <functional>
#include <map>

#include "node_fields.h"

namespace mrpt_sgraphs {

/// What happens when nodes of a graph are clicked on: they get a box, and what the graph says of
/// them stands in rviz's Selection panel as long as they are selected, up to date.
class NodeSelection final : public rviz::SelectionHandler {
 public:
  struct Source {
    std::function<NodeFields(NodeId)> fields;          ///< Empty: there is no such node now.
    std::function<Ogre::AxisAlignedBox(NodeId)> box;   ///< In the fixed frame; null likewise.
    std::function<void(bool by_node)> colour_by_node;  ///< As SceneObjects::colourByNode.
  };

  NodeSelection(rviz::DisplayContext* context, Source source);

  /// After the graph or its place has changed.
  void graphChanged();

 private:
  void preRenderPass(std::uint32_t pass) override;
  void postRenderPass(std::uint32_t pass) override;
  bool needsAdditionalRenderPass(std::uint32_t pass) override { return pass == 1; }
  void createProperties(const rviz::Picked& picked, rviz::Property* parent) override;
  void destroyProperties(const rviz::Picked& picked, rviz::Property* parent) override;
  void updateProperties() override;
  void getAABBs(const rviz::Picked& picked, rviz::V_AABB& boxes) override;
  void onSelect(const rviz::Picked& picked) override;
  void onDeselect(const rviz::Picked& picked) override;

  void showBox(std::uint64_t index);
  void fill(std::uint64_t index, rviz::Property* group) const;

  const Source source_;
  std::map<std::uint64_t, rviz::Property*> groups_;  ///< By pickIndex; those of the panel.
  bool is_stale_ = false;
};

}  // namespace mrpt_sgraphs
