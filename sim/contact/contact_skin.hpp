#pragma once

#include <cstdint>
#include <vector>

#include "model/binding.hpp"
#include "model/chain.hpp"
#include "model/vec.hpp"

namespace springlod::sim {

/// The surface of the base, bound to the nodes of one of its levels: P points at which the level
/// touches obstacles where the base does, because the level's own nodes lie deeper inside. Each
/// point is the mean of a flat patch of the points of the base's surface (BodySurface) whose main
/// nodes are in one group (flat_patches), and has their contact area, so the total contact
/// stiffness is the base's. A point of a true surface (ContactSurface) is a patch by itself: the
/// mean of several would lie below a round one.
struct ContactSkin {
  Binding of_nodes;                      ///< P rows; see lod/transfer.hpp
  std::vector<double> area;              ///< [m2] > 0, P
  std::vector<std::uint32_t> base_node;  ///< main base node of the largest point of each patch, P
  std::vector<double> contact;           ///< sum of BodySurface::contact [N/m] > 0, P
  /// Local surface compliance that merging removed [m/N], P: symmetric positive semidefinite, in
  /// the axes of the body at rest; eq. 65a of docs/method.md. It turns with the body: see
  /// ContactPoints::yielding.
  std::vector<Mat3> compliance;
};

/// The skin of level `level`; that of level 0 is the base's own points. Throws InputError if there
/// is no such level.
ContactSkin contact_skin(const LodChain& chain, std::uint32_t level);

/// Throws InputError unless each point has an area above 0, a node of the base, and nodes below
/// `node_count`.
void validate(const ContactSkin& skin, std::uint32_t node_count);

}  // namespace springlod::sim
