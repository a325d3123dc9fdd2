#pragma once

#include <vector>

#include "model/chain.hpp"
#include "model/corners.hpp"

namespace springlod::lod {

/// The corners of a merged model (docs/method.md, section 4). A fine corner whose nodes lie in four
/// different groups becomes a corner of the nodes of these groups, which lie at the rest positions
/// `rest` [m]. Equal corners become one, with the mean of their E. Of corners with the same four
/// nodes and different apexes, that with the lowest apex is kept: all have the volume of one
/// tetrahedron. Corners flatter than kFlatCorner are left out.
///
/// `fine` is sorted by nodes, as in a model. The time is linear in the number of corners, apart
/// from the sorts of the few corners of each group.
std::vector<Corner> merge_corners(const std::vector<Corner>& fine, const Groups& groups,
                                  const std::vector<Vec3>& rest);

}  // namespace springlod::lod
