#include "model/spring_rows.hpp"

#include <cassert>

namespace springlod::inline model {

SpringRows::SpringRows(std::uint32_t node_count, const std::vector<std::uint32_t>& a,
                       const std::vector<std::uint32_t>& b)
    : b_(b),
      start_(node_count + 1, Start{0, 0}),
      lower_(std::make_unique_for_overwrite<Lower[]>(b.size())) {
  assert(a.size() == b.size());
  for (std::uint32_t s = 0; s < spring_count(); ++s) {
    assert(a[s] < b[s] && b[s] < node_count);
    assert(s == 0 || a[s - 1] < a[s] || (a[s - 1] == a[s] && b[s - 1] < b[s]));
    ++start_[b[s]].lower;
    ++start_[a[s]].higher;
  }
  Start end{0, 0};
  for (Start& start : start_) {
    end.lower += start.lower;
    end.higher += start.higher;
    start = {end.lower, end.higher - start.higher};
  }
  // `lower` is the end of each row here. Filling the row backwards moves this index to its start.
  for (std::uint32_t s = spring_count(); s-- > 0;) lower_[--start_[b[s]].lower] = {a[s], s};
}

}  // namespace springlod::inline model
