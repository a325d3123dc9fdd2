#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// The dilatation terms that each node is in.
class TermsOfNodes {
 public:
  explicit TermsOfNodes(const MassSpringModel& model) : places_(model.node_count()) {
    const DilatationTerms& terms = model.dilatation;
    for (std::uint32_t t = 0; t < terms.count(); ++t)
      for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e)
        places_[terms.node[e]].push_back({t, e});
  }

  struct Place {
    std::uint32_t term;
    std::uint32_t entry;  ///< of the node, among those of all terms
  };
  /// By ascending term.
  const std::vector<Place>& of(std::uint32_t node) const { return places_[node]; }

 private:
  std::vector<std::vector<Place>> places_;  // N
};

}  // namespace springlod::inline model
