#pragma once

#include <vector>

#include "model/binding.hpp"
#include "model/chain.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// Entries of a binding with a smaller |weight| are dropped from a slim asset [1]. A quarter of
/// those of a lattice's surface are, most of those between levels.
inline constexpr double kLeastSlimWeight = 0.05;

/// The binding with fewer entries, and with weights that are whole multiples of a power of 2 and
/// fit into 16 bits. Small weights are dropped, and the rest of the row changes as little as makes
/// up for them (least squares): the weights add up to 1, and affine motions are interpolated as
/// before, to the rounding of the weights. A row stays whole if its other nodes cannot do that.
/// `rest`: positions of the nodes [m].
Binding slim_binding(const Binding& binding, const std::vector<Vec3>& rest);

/// The smallest power of 2, from 2^-14, of which the weights are at most 32767 - `room` in
/// magnitude.
double weight_unit(const std::vector<double>& weights, double room = 0);

/// What a slim asset holds of an asset (docs/asset-format.md): the same without certificates, in
/// values that have single precision, and with slim bindings. Its provenance says so. If no
/// spring of a level has a force at rest, none has afterwards; likewise the dilatation terms.
/// Throws InputError for an asset that does not validate in single precision, such as one of small
/// cells far from the origin.
LodAsset slimmed(const LodAsset& asset);

}  // namespace springlod::inline model
