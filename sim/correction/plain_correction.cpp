#include "sim/correction/plain_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/run/motion.hpp"

namespace springlod::sim {
namespace {

/// The paths between two vectors of positions.
class VectorPaths final : public StepPaths {
 public:
  VectorPaths(const std::vector<Vec3>& from, const std::vector<Vec3>& to)
      : from_(&from), to_(&to) {}
  void read(std::span<const std::uint32_t> nodes, std::span<PaddedPath> paths) const override {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      paths[i] = {padded((*from_)[nodes[i]]), padded((*to_)[nodes[i]])};
  }

 private:
  const std::vector<Vec3>* from_;
  const std::vector<Vec3>* to_;
};

}  // namespace

PlainCorrection::PlainCorrection(const MassSpringModel& model, const ContactPoints& points,
                                 ContactFinder& finder, std::size_t obstacle_count, bool volumes,
                                 const StepCorrection::Holds& holds)
    : model_(&model),
      points_(&points),
      obstacle_count_(obstacle_count),
      solver_(model, points, finder, volumes, holds),
      watch_(model.corner_count()),
      due_(model.corner_count(), kDueAtOnce) {}

void PlainCorrection::correct(double step, const std::vector<Vec3>& x, std::vector<Vec3>& x_next,
                              std::vector<Vec3>& v_next) {
  const VectorPaths paths(x, x_next);
  solver_.begin(step, paths);
  check_contacts(x, x_next);
  solver_.solve_contacts();
  solver_.solve_resisting(watch_);
  if (!model_->corners.empty()) correct_corners(step, x, x_next);
  solver_.finish();
  for (const NodeChange& change : solver_.changes()) {
    x_next[change.node] += change.displacement;
    v_next[change.node] += change.kick;
  }
  watch_.corrected(solver_.take_travel(), solver_.resisting());
}

void PlainCorrection::check_contacts(const std::vector<Vec3>& x, const std::vector<Vec3>& x_next) {
  for (std::uint32_t o = 0; o < obstacle_count_; ++o)
    for (std::uint32_t p = 0; p < points_->count(); ++p) {
      const Contact* next = solver_.next_contact();  // in the order of the checks, as they made it
      if (next != nullptr && next->obstacle == o && next->point == p)
        solver_.continue_contact();
      else
        solver_.check_contact(o, p, {points_->interpolate(p, x), points_->interpolate(p, x_next)});
    }
}

void PlainCorrection::correct_corners(double step, const std::vector<Vec3>& x,
                                      const std::vector<Vec3>& x_next) {
  double travel = free_travel(step, x, x_next);
  do {
    if (watch_.moved(travel + solver_.take_travel())) look(step, x, x_next);
    travel = 0;
    watch_.check(
        [&](std::uint32_t corner, bool resisted) { solver_.check_corner(corner, resisted); });
  } while (solver_.solve_corners());
}

double PlainCorrection::free_travel(double step, const std::vector<Vec3>& x,
                                    const std::vector<Vec3>& x_next) const {
  const Vec3 from = springlod::center_of_mass(*model_, x);
  const Vec3 displacement = springlod::center_of_mass(*model_, x_next) - from;
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 rigid = displacement + step * spin_.cross(x[i] - from);
    most = std::max(most, (x_next[i] - x[i] - rigid).squaredNorm());
  }
  return std::sqrt(most);
}

void PlainCorrection::look(double step, const std::vector<Vec3>& x,
                           const std::vector<Vec3>& x_next) {
  State state{x, x_next, 0};
  for (std::size_t i = 0; i < x.size(); ++i) state.v[i] = (x_next[i] - x[i]) / step;
  spin_ = angular_velocity(*model_, state);
  state.x = x_next;
  const StepNodes& nodes = solver_.nodes();
  for (std::uint32_t i = 0; i < nodes.count(); ++i) state.x[nodes.node(i)] = nodes.at(i);
  look_at_corners(state.x);
}

void PlainCorrection::look_at_corners(const std::vector<Vec3>& x) {
  found_.clear();
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t c = 0; c < model_->corner_count(); ++c) {
    if (!(watch_.travel() < due_[c])) {
      const double margin = corner_margin(model_->corners[c], model_->rest, x);
      const bool has_margin = margin >= 0;
      if (!has_margin) found_.push_back(c);
      due_[c] = has_margin ? due_travel(watch_.travel(), margin) : kDueAtOnce;
    }
    least = std::min(least, due_[c]);
  }
  watch_.found(found_);
  watch_.looked(least);
}

}  // namespace springlod::sim
