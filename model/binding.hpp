#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// A linear map from node positions (or velocities) to points: point p = sum over its entries of
/// weight * node. Weights of a point add up to 1 and reproduce the point's rest position, so rigid
/// and affine motions are carried exactly. (Where the nodes at hand lie in a plane, a line or a
/// point, the rest position is that of the point's projection.) Compressed rows, P points.
struct Binding {
  std::vector<std::uint32_t> start;  ///< P + 1
  std::vector<std::uint32_t> node;
  std::vector<double> weight;
  std::uint32_t point_count() const {
    return start.empty() ? 0 : static_cast<std::uint32_t>(start.size() - 1);
  }
};

/// Throws InputError unless the rows are well formed, the weights finite and the nodes below
/// `node_count`.
void validate(const Binding& binding, std::uint32_t node_count);

struct BindOptions {
  /// Nodes per point at most: 8 as in a cell of the lattice; 4 is the least for linear precision.
  std::uint32_t nodes_per_point = 8;
};

/// Binds points to the nearest node and the nearest of that node's neighbours up to two springs
/// away, so that a point never hangs on a limb that is near but not joined. If those lie in a plane
/// though the node has others off it, the farthest make room for such. Throws InputError for a
/// model without nodes or fewer than 4 nodes per point.
Binding bind_points(const std::vector<Vec3>& points, const MassSpringModel& model,
                    const BindOptions& options = {});

/// Moving-least-squares weights of first order (Lancaster & Salkauskas 1981) of one point over the
/// candidate nodes `nodes` of `model`, appended as a new row, the nearest node first: the w that
/// minimise sum w_j^2 / phi_j under sum w_j = 1 and sum w_j X_j = point, phi falling with distance.
/// A point on a node gets that node alone. Weights stay tame: a point many times farther outside
/// than the nodes are apart is pulled back towards them. The building block of `bind_points` and of
/// the transfer between levels. Throws InputError for no candidates.
void append_bound_point(Binding& binding, const Vec3& point, const MassSpringModel& model,
                        const std::vector<std::uint32_t>& nodes);

/// The map `outer` after `inner`: outer binds to points that inner binds to nodes. Entries of a
/// row in rising order of node.
Binding compose(const Binding& outer, const Binding& inner);

/// Positions (or velocities) of the points, carried by the nodes.
std::vector<Vec3> carry(const Binding& binding, const std::vector<Vec3>& nodes);

}  // namespace springlod::inline model
