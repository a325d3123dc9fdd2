#include "sim/contact/step_correction.hpp"

namespace springlod::sim {

void correct_step(const ContactPoints& points, std::size_t obstacle_count, double step,
                  const std::vector<Vec3>& x, StepContacts& contacts, std::vector<Vec3>& x_next,
                  std::vector<Vec3>& v_next) {
  contacts.begin(step);
  auto was = contacts.before().begin();  // in the order of the checks, as they made it
  for (std::uint32_t o = 0; o < obstacle_count; ++o)
    for (std::uint32_t p = 0; p < points.count(); ++p) {
      const bool touched = was != contacts.before().end() && was->obstacle == o && was->point == p;
      contacts.check(o, p, touched ? &*was : nullptr,
                     {points.interpolate(p, x), points.interpolate(p, x_next)});
      if (touched) ++was;
    }
  contacts.solve(
      [&](std::uint32_t node) {
        return StepContacts::Path{x[node], x_next[node]};
      },
      [](std::uint32_t node) { return node; });
  for (const NodeChange& change : contacts.changes()) {
    x_next[change.node] += change.displacement;
    v_next[change.node] += change.kick;
  }
}

}  // namespace springlod::sim
