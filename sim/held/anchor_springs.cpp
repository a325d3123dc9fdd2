#include "sim/held/anchor_springs.hpp"

namespace springlod::sim {

AnchorSprings::AnchorSprings(const MassSpringModel& model, const std::vector<Anchor>& anchors,
                             const std::vector<Vec3>& start)
    : places_(model, anchors, start, HeldNodes::By::springs) {
  for (const Anchor& anchor : anchors) {
    if (!anchor.spring) continue;
    for (const double stiffness : shared_stiffness(anchor, model)) {
      stiffness_.push_back(stiffness);
      damping_.push_back(anchor.spring->damping * stiffness);
    }
  }
  for (const std::uint32_t node : nodes()) mass_.push_back(model.mass[node]);
}

}  // namespace springlod::sim
