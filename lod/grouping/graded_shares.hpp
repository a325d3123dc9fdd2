#pragma once

#include <cstdint>
#include <vector>

namespace springlod::lod {

/// Nodes that share groups among each other only.
struct SharedNodes {
  std::uint32_t nodes = 0;
  double squared_frequency = 0;  ///< that they swing with by themselves [rad2/s2]; 0: unknown
};

/// `count` groups shared out among kinds of nodes, each 1 to as many as it has nodes.
///
/// With `grading` 0 by the numbers of nodes. The stable step is that of the stiffest nodes, and a
/// group of n nodes swings about n^(2/3) times slower (squared), so with `grading` 1 each kind gets
/// so many that all come to swing alike; in between, in between. Never less than half nor more than
/// twice as many as even, and not fewer for grading's sake than give a kind a shape (24).
/// Throws InputError if `count` is less than the kinds or more than the nodes, or for a grading
/// outside 0 .. 1.
std::vector<std::uint32_t> graded_shares(const std::vector<SharedNodes>& kinds, std::uint32_t count,
                                         double grading);

}  // namespace springlod::lod
