#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::inline model {

struct MassSpringModel;

/// A linear map from node positions (or velocities) to P points, as compressed rows: a point is the
/// sum of weight * node over the entries of its row. The weights of a point add up to 1 and
/// reproduce its rest position, so rigid and affine motions are interpolated exactly. If the nodes
/// of a row lie in a plane, a line or a point, they reproduce the projection of the rest position.
struct Binding {
  std::vector<std::uint32_t> start;  ///< P + 1; entries start[p] .. start[p+1]-1 belong to point p
  std::vector<std::uint32_t> node;
  std::vector<double> weight;
  std::uint32_t point_count() const {
    return start.empty() ? 0 : static_cast<std::uint32_t>(start.size() - 1);
  }
};

/// Throws InputError unless the rows are valid, the nodes below `node_count`, and the weights of
/// each point bounded, with the sum 1.
void validate(const Binding& binding, std::uint32_t node_count);

/// Largest number of nodes per point: as in a cell of the lattice. Affine motions need at least 4.
inline constexpr std::uint32_t kNodesPerPoint = 8;

/// Binds each point to its nearest node and the nearest of the neighbours up to two springs away.
/// Therefore, a point is never bound to a part of the body that is close to it but not connected.
/// If these nodes are coplanar, the farthest are replaced by nearby nodes outside the plane, if
/// there are any. Throws InputError for a model without nodes.
Binding bind_points(const std::vector<Vec3>& points, const MassSpringModel& model);

/// Appends a row with the moving-least-squares weights of first order of one point (Lancaster &
/// Salkauskas 1981; docs/method.md, eq. 26): the w that minimise sum w_j^2 / phi_j with sum w_j = 1
/// and sum w_j X_j = point, over the candidate nodes `nodes` of `model`. The kernel phi decreases
/// with the distance. The nearest node is the first entry; a point at a node depends on that node
/// alone.
///
/// The weights are bounded: a point far outside the nodes, compared with their distances, is
/// projected back towards them. `bind_points` and the transfer between levels are built on it.
/// Throws InputError for an empty list.
void append_bound_point(Binding& binding, const Vec3& point, const MassSpringModel& model,
                        const std::vector<std::uint32_t>& nodes);

/// The map `outer` after `inner`: `outer` maps the points of `inner`, which maps nodes. The entries
/// of a row are in ascending order of node. Throws InputError if `inner` has other points than
/// `outer` maps.
Binding compose(const Binding& outer, const Binding& inner);

/// Positions (or velocities) of the P points, interpolated from N node values.
std::vector<Vec3> interpolate(const Binding& binding, const std::vector<Vec3>& nodes);

}  // namespace springlod::inline model
