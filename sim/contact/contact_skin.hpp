#pragma once

#include <cstdint>
#include <vector>

#include "base/choice.hpp"
#include "model/binding.hpp"
#include "model/chain.hpp"

namespace springlod::sim {

/// The surface of the base, bound to the nodes of one of its levels: P points at which the level
/// touches obstacles where the base does, because the level's own nodes lie deeper inside. Each
/// point is a base node with a contact area and keeps that area, so the total contact stiffness is
/// the base's.
struct ContactSkin {
  Binding of_nodes;                      ///< P rows; see lod/transfer.hpp
  std::vector<double> area;              ///< [m2] > 0, P
  std::vector<std::uint32_t> base_node;  ///< their base nodes, ascending, P
  /// Local surface compliance that merging removed, neighbours held [m/N] >= 0, P: eq. 65 of
  /// docs/method.md. It is added in series with the contact penalty, and as a tangential contact
  /// spring (stick spring) of the same compliance with friction.
  std::vector<double> compliance;
};

/// Where the levels of a chain touch obstacles.
enum class ContactAt {
  nodes,   ///< their own
  surface  ///< the surface of the base: see contact_skin
};

inline constexpr Choice<ContactAt> kContacts[] = {
    {ContactAt::nodes, "nodes", "at its own nodes, which lie inside its base's surface"},
    {ContactAt::surface, "surface", "at the base's surface, which its nodes carry"}};
constexpr ChoiceTable<Choice<ContactAt>> choices(ContactAt) {
  return {"contact", kContacts};
}

/// The skin of level `level`; for level 0, the base's own nodes. Throws InputError if there is no
/// such level.
ContactSkin contact_skin(const LodChain& chain, std::uint32_t level);

/// Throws InputError unless each point has an area above 0 and a base node, and refers only to
/// nodes below `node_count`.
void validate(const ContactSkin& skin, std::uint32_t node_count);

}  // namespace springlod::sim
