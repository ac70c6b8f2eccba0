// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/factor_shelf.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {
namespace {

const std::vector<FactorId> kNone;

template <typename Key>
void unlist(const Key& key, FactorId id, std::unordered_map<Key, std::vector<FactorId>>* lists) {
  const auto list = lists->find(key);
  auto& ids = list->second;
  ids.erase(std::find(ids.begin(), ids.end(), id));
  if (ids.empty()) lists->erase(list);
}

template <typename Key>
const std::vector<FactorId>& listOf(
    const Key& key, const std::unordered_map<Key, std::vector<FactorId>>& lists) {
  const auto list = lists.find(key);
  return list == lists.end() ? kNone : list->second;
}

}  // namespace

void FactorShelf::add(const ShelvedFactor& shelved) {
  slots_[shelved.id] = static_cast<uint32_t>(factors_.size());
  factors_.push_back(shelved);
  for (int k = 0; k < shelved.factor->nodeCount(); ++k) {
    by_node_[shelved.factor->node(k)].push_back(shelved.id);
  }
  if (shelved.kept) by_kept_[*shelved.kept].push_back(shelved.id);
}

ShelvedFactor FactorShelf::take(FactorId id) {
  const ShelvedFactor taken = at(id);
  const uint32_t slot = slots_.at(id);
  for (int k = 0; k < taken.factor->nodeCount(); ++k) unlist(taken.factor->node(k), id, &by_node_);
  if (taken.kept) unlist(*taken.kept, id, &by_kept_);
  slots_.erase(id);
  if (slot + 1 < factors_.size()) {  // the last one takes the free place
    factors_.edit(slot) = ShelvedFactor(factors_.back());
    slots_[factors_[slot].id] = slot;
  }
  factors_.pop_back();
  return taken;
}

const ShelvedFactor& FactorShelf::at(FactorId id) const {
  const auto found = slots_.find(id);
  if (found == slots_.end()) {
    throw std::out_of_range("factor " + std::to_string(id.value) + " is not on the shelf");
  }
  return factors_[found->second];
}

const std::vector<FactorId>& FactorShelf::of(NodeId node) const { return listOf(node, by_node_); }

const std::vector<FactorId>& FactorShelf::keptBy(KeyframeId kept) const {
  return listOf(kept, by_kept_);
}

void FactorShelf::setKept(FactorId id, std::optional<KeyframeId> kept) {
  const ShelvedFactor& shelved = at(id);
  if (shelved.kept) unlist(*shelved.kept, id, &by_kept_);
  factors_.edit(slots_.at(id)).kept = kept;
  if (kept) by_kept_[*kept].push_back(id);
}

}  // namespace mrpt_sgraphs
