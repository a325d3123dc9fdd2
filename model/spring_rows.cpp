#include "model/spring_rows.hpp"

namespace springlod {

SpringRows::SpringRows(const MassSpringModel& model)
    : model_(model),
      start_(model.node_count() + 1, Start{0, 0}),
      lower_(std::make_unique_for_overwrite<Lower[]>(model.spring_count())) {
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    ++start_[model.b[s]].lower;
    ++start_[model.a[s]].higher;
  }
  Start end{0, 0};
  for (Start& start : start_) {
    end.lower += start.lower;
    end.higher += start.higher;
    start = {end.lower, end.higher - start.higher};
  }
  // `lower` is the end of each row by now, and comes down to its start as the row is filled from
  // behind.
  for (std::uint32_t s = model.spring_count(); s-- > 0;)
    lower_[--start_[model.b[s]].lower] = {model.a[s], s};
}

}  // namespace springlod
