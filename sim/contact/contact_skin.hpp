#pragma once

#include <cstdint>
#include <vector>

#include "base/choice.hpp"
#include "model/binding.hpp"
#include "model/chain.hpp"

namespace springlod::sim {

/// The surface of the base, on the nodes of one of its levels: P points at which the level touches
/// obstacles as the base does, though its own nodes lie deeper. Each point is one of the base's
/// nodes with an area and keeps that area, so that all of them together are as stiff as the base's.
struct ContactSkin {
  Binding of_nodes;                      ///< P rows; see lod/transfer.hpp
  std::vector<double> area;              ///< [m2] > 0, P
  std::vector<std::uint32_t> base_node;  ///< which of the base's they are, rising, P
  /// How far the base's node gives way to a force out of its surface while its neighbours stay
  /// [m/N], P. Merging took that from all nodes that are not their own group; the contact gives it
  /// back, as a spring between point and obstacle, and as soft a one along the surface, by which
  /// friction holds the point.
  std::vector<double> give;
};

/// Where the levels of a chain touch obstacles.
enum class ContactAt {
  nodes,   ///< their own
  surface  ///< that of their base: see contact_skin
};

inline constexpr Choice<ContactAt> kContacts[] = {
    {ContactAt::nodes, "nodes", "at its own nodes, which lie inside its base's surface"},
    {ContactAt::surface, "surface", "at the base's surface, which its nodes carry"}};
constexpr ChoiceTable<Choice<ContactAt>> choices(ContactAt) {
  return {"contact", kContacts};
}

/// Of level `level`; that of level 0 is the base's own nodes. Throws InputError if there is no such
/// level.
ContactSkin contact_skin(const LodChain& chain, std::uint32_t level);

/// Throws InputError unless there is an area above 0 and a node of the base for each point, and
/// each hangs on nodes below `node_count`.
void validate(const ContactSkin& skin, std::uint32_t node_count);

}  // namespace springlod::sim
