#include "lod/merging/merge_dilatation.hpp"

#include <cmath>
#include <vector>

#include "model/node_dilatation.hpp"

namespace springlod::lod {

DilatationTerms merge_dilatation(const MassSpringModel& fine, const Groups& groups,
                                 const MassSpringModel& coarse) {
  if (fine.dilatation.empty()) return {};
  const DilatationShares shares = dilatation_shares(fine);
  std::vector<NodeDilatation> of_groups(groups.count);
  std::vector<double> size(groups.count, 0);  // sum of |modulus|
  for (std::uint32_t i = 0; i < fine.node_count(); ++i) {
    NodeDilatation& of_group = of_groups[groups.of[i]];
    of_group.modulus += shares.modulus[i];
    of_group.damping_time += std::abs(shares.modulus[i]) * shares.damping_time[i];
    size[groups.of[i]] += std::abs(shares.modulus[i]);
  }
  for (std::uint32_t g = 0; g < groups.count; ++g)
    if (size[g] > 0) of_groups[g].damping_time /= size[g];
  return node_terms(coarse, of_groups);
}

}  // namespace springlod::lod
