// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "node_selection.h"

#include <rviz/properties/property.h>
#include <rviz/properties/string_property.h>

#include <string>
#include <utility>

#include "scene_objects.h"

namespace mrpt_sgraphs {
namespace {

NodeId nodeAt(std::uint64_t index) { return pickedNode(static_cast<std::uint32_t>(index)); }

}  // namespace

NodeSelection::NodeSelection(rviz::DisplayContext* context, Source source)
    : SelectionHandler(context), source_(std::move(source)) {}

void NodeSelection::graphChanged() {
  is_stale_ = true;
  for (const auto& [index, group] : groups_) showBox(index);
}

void NodeSelection::preRenderPass(std::uint32_t pass) {
  SelectionHandler::preRenderPass(pass);
  if (pass == 1) source_.colour_by_node(true);
}

void NodeSelection::postRenderPass(std::uint32_t pass) {
  SelectionHandler::postRenderPass(pass);
  if (pass == 1) source_.colour_by_node(false);
}

void NodeSelection::createProperties(const rviz::Picked& picked, rviz::Property* parent) {
  for (const std::uint64_t index : picked.extra_handles) {
    if (groups_.count(index) != 0) continue;
    auto* const group = new rviz::Property(QString::fromStdString(nameOf(nodeAt(index))),
                                           QVariant(), "A node of the graph.", parent);
    fill(index, group);
    group->expand();
    groups_[index] = group;
  }
}

void NodeSelection::destroyProperties(const rviz::Picked& picked, rviz::Property* /*parent*/) {
  for (const std::uint64_t index : picked.extra_handles) {
    const auto found = groups_.find(index);
    if (found == groups_.end()) continue;
    delete found->second;
    groups_.erase(found);
  }
}

void NodeSelection::updateProperties() {
  if (!is_stale_) return;
  is_stale_ = false;
  for (const auto& [index, group] : groups_) fill(index, group);
}

/// Values that changed are written where they stand, so that the panel does not jump.
void NodeSelection::fill(std::uint64_t index, rviz::Property* group) const {
  NodeFields fields = source_.fields(nodeAt(index));
  if (fields.empty()) fields.emplace_back("gone", "no longer in the graph");
  const auto count = static_cast<int>(fields.size());
  if (group->numChildren() > count) group->removeChildren(count);
  for (int k = 0; k < count; ++k) {
    const QString name = QString::fromStdString(fields[static_cast<std::size_t>(k)].first);
    const QString value = QString::fromStdString(fields[static_cast<std::size_t>(k)].second);
    if (k >= group->numChildren()) {
      auto* const field = new rviz::StringProperty(name, value, "", group);
      field->setReadOnly(true);
    } else {
      group->childAt(k)->setName(name);
      group->childAt(k)->setValue(value);
    }
  }
}

void NodeSelection::getAABBs(const rviz::Picked& picked, rviz::V_AABB& boxes) {
  for (const std::uint64_t index : picked.extra_handles) {
    const Ogre::AxisAlignedBox box = source_.box(nodeAt(index));
    if (!box.isNull()) boxes.push_back(box);
  }
}

void NodeSelection::showBox(std::uint64_t index) {
  const Ogre::AxisAlignedBox box = source_.box(nodeAt(index));
  if (box.isNull()) {
    destroyBox({getHandle(), index});
  } else {
    createBox({getHandle(), index}, box, "RVIZ/Cyan");
  }
}

void NodeSelection::onSelect(const rviz::Picked& picked) {
  for (const std::uint64_t index : picked.extra_handles) showBox(index);
}

void NodeSelection::onDeselect(const rviz::Picked& picked) {
  for (const std::uint64_t index : picked.extra_handles) destroyBox({getHandle(), index});
}

}  // namespace mrpt_sgraphs
