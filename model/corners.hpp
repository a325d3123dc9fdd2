#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::inline model {

struct MassSpringModel;

/// A corner of a cell: a node and its three neighbours along the edges. A spring has a length but
/// no side, so a soft body can turn inside out with all springs at their rest lengths. The sign of
/// the volume of its corners tells the two states apart (docs/method.md, section 2).
///
/// The volume is that of the parallelepiped of the three edges, det(x1 - x0, x2 - x0, x3 - x0)
/// [m3], and J = V / V0 is its ratio [1] to the volume V0 at rest. A corner has no energy above J =
/// kCornerResists. Below it, its energy grows with falling J, ever more steeply, on the scale E V0
/// / 8: a cell has eight corners, each for an eighth of the cell.
///
/// Standard form: V0 > 0, and node[1] is the lowest of the three neighbours.
struct Corner {
  /// The corner's node, then its three neighbours.
  std::array<std::uint32_t, 4> node{};
  double young = 0;  ///< Young's modulus of the material [Pa] > 0

  bool operator==(const Corner&) const = default;
};

/// J below which a corner resists [1]. Most bodies never compress a corner so far, so the moduli of
/// a model stay those of its springs. It leaves room to turn a fast corner before J = 0.
inline constexpr double kCornerResists = 0.4;
/// Least corner_shape at rest [1]. The stiffness of a corner against a displacement of a node is in
/// proportion to 1 / corner_shape. With this bound, it is at most five times that of a cube's
/// corner, and rounding and small strains do not decide on the side of a corner.
inline constexpr double kFlatCorner = 0.2;

/// Factor of corner_margin() [1]. The volume falls by at most 2 Q d while all nodes move by a small
/// d. Until a corner can resist, Q may grow, by a factor whose mean over the way is at most 37/27.
inline constexpr double kMarginPart = 27.0 / 74;

/// Signed volume [m3] of a corner at the positions x [m].
double corner_volume(const Corner& corner, const std::vector<Vec3>& x);
/// Volume over the product of the lengths of the three edges [1]: 1 for a cube, 0 if flat, negative
/// if inverted. It is 0 if an edge has no length.
double corner_shape(const Corner& corner, const std::vector<Vec3>& x);
/// Numbers of the corners with V <= 0 (or not finite) at the positions x [m], ascending.
std::vector<std::uint32_t> inverted_corners(const std::vector<Corner>& corners,
                                            const std::vector<Vec3>& x);

/// The three edges from the corner's node: the sum of their squares [m2].
double corner_squares(const Corner& corner, const std::vector<Vec3>& x);
/// How far the four nodes of a corner may move from the positions x, each in any direction and
/// relative to a rigid motion, until J can fall to kCornerResists: kMarginPart (V - V') / Q, with
/// the volume V' there and Q = corner_squares() [m]. Below 0 if J is lower, not a number if J is
/// not. See section 2 of docs/method.md.
double corner_margin(const Corner& corner, const std::vector<Vec3>& rest,
                     const std::vector<Vec3>& x);

/// Brings a corner with four different nodes into the standard form. False if it is flatter than
/// kFlatCorner at the rest positions [m]; a model must not have such a corner.
bool orient(Corner& corner, const std::vector<Vec3>& rest);
/// Orients all corners, removes those that are too flat, and sorts the rest by their nodes. Must be
/// called after a change of the rest positions other than a rigid motion or a uniform scaling.
void settle_corners(std::vector<Corner>& corners, const std::vector<Vec3>& rest);

/// Throws InputError with the first corner that breaks a rule: four different nodes of the model in
/// the standard form, springs from node[0] to the other three, sorted by node, none twice, finite
/// young > 0, corner_shape >= kFlatCorner at rest.
void validate_corners(const MassSpringModel& model);

}  // namespace springlod::inline model
