#pragma once

#include <cstdint>
#include <vector>

namespace springlod::lod {

/// A kind of nodes: nodes that may be grouped with one another and with no others.
struct NodeKind {
  std::uint32_t nodes = 0;       ///< number of nodes
  double squared_frequency = 0;  ///< median node bound on omega^2 [rad2/s2]; 0: unknown
};

/// Distributes `count` groups over kinds of nodes; each kind gets at least 1 group and at most one
/// for each node (docs/method.md, eq. 24).
///
/// With `grading` 0 the shares are proportional to the numbers of nodes. The stiffest nodes
/// determine the stable time step, and a group of n nodes has about n^(-2/3) of the squared
/// frequency of one node. So with `grading` 1 all kinds get about the same highest frequency. A
/// share is at least half and at most twice the proportional one; grading leaves a kind at least 24
/// groups, or its proportional share if that is less. Throws InputError if `count` is less than the
/// kinds or more than the nodes, or for a grading outside 0 .. 1.
std::vector<std::uint32_t> graded_shares(const std::vector<NodeKind>& kinds, std::uint32_t count,
                                         double grading);

}  // namespace springlod::lod
