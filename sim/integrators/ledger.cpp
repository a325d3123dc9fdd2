#include "sim/integrators/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {

double closure_error(const std::vector<LedgerEntry>& ledger) {
  double largest_gap = 0;
  double largest_kinetic = 0;
  for (const LedgerEntry& entry : ledger) {
    largest_gap = std::max(largest_gap, std::abs(entry.total() - ledger.front().total()));
    largest_kinetic = std::max(largest_kinetic, entry.kinetic);
  }
  return largest_kinetic > 0 ? largest_gap / largest_kinetic : 0;
}

}  // namespace springlod::sim
