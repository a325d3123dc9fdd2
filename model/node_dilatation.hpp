#pragma once

#include <vector>

#include "model/dilatation.hpp"
#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// What the term of a node should have.
struct NodeDilatation {
  double modulus = 0;       ///< [J]; 0: the node gets no term
  double damping_time = 0;  ///< [s]
};

/// A dilatation term for each node with a modulus, over the node and its nearest neighbours;
/// `of_nodes`: N. F is the affine motion closest to that of these nodes: b_j = A^-1 (x_j - m), with
/// their mean m and A = sum_j (x_j - m)(x_j - m)^T (docs/method.md, eq. 8e).
///
/// Nodes nearly in a plane would measure the strain across it by small distances: b, and with it
/// the highest frequency, would be large. There all neighbours belong to the term, or theirs too.
/// If that is not enough, as in a sheet one cell thick, the node has no term.
DilatationTerms node_terms(const MassSpringModel& model,
                           const std::vector<NodeDilatation>& of_nodes);

/// The same with T = Lambda V of the material and volume of each node, times a factor for each
/// material; none: 1.
DilatationTerms material_terms(const MassSpringModel& model,
                               const std::vector<double>& factors = {});

}  // namespace springlod::inline model
