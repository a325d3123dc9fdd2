#include "sim/held/anchor.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "model/anchors.hpp"

namespace springlod::sim {
namespace {

void validate_path(const Anchor& anchor) {
  double before = 0;
  for (const AnchorKey& key : anchor.path) {
    if (!(std::isfinite(key.time) && key.time > before))
      throw InputError(
          fmt::format("anchor \"{}\": the time {:g} s of a pose on its path must be later than "
                      "{:g} s; the start of the run has none",
                      anchor.name, key.time, before));
    if (!key.move.allFinite() || !key.turn.allFinite())
      throw InputError(
          fmt::format("anchor \"{}\": its pose at {:g} s must be finite", anchor.name, key.time));
    before = key.time;
  }
  if (anchor.pivot && !anchor.pivot->allFinite())
    throw InputError(fmt::format("anchor \"{}\": its pivot must be finite", anchor.name));
}

}  // namespace

void validate(const std::vector<Anchor>& anchors, const MassSpringModel& model) {
  std::vector<const Anchor*> of_node(model.node_count(), nullptr);
  for (const Anchor& anchor : anchors) {
    if (anchor.nodes.empty())
      throw InputError(fmt::format("anchor \"{}\" holds no node", anchor.name));
    const std::vector<std::uint8_t> flags = anchor_flags(model, anchor.nodes);
    for (std::uint32_t i = 0; i < flags.size(); ++i) {
      if (flags[i] == 0) continue;
      if (of_node[i] != nullptr)
        throw InputError(fmt::format("anchors \"{}\" and \"{}\" both hold node {}",
                                     of_node[i]->name, anchor.name, script_number(i)));
      of_node[i] = &anchor;
    }
    validate_path(anchor);
  }
}

std::vector<Anchor> mapped(const std::vector<Anchor>& anchors, const Groups& of_base) {
  std::vector<Anchor> of_level = anchors;
  for (Anchor& anchor : of_level) anchor.nodes = mapped_nodes(of_base, anchor.nodes);
  return of_level;
}

std::vector<std::uint32_t> nodes_of(const std::vector<Anchor>& anchors) {
  std::vector<std::uint32_t> nodes;
  for (const Anchor& anchor : anchors)
    nodes.insert(nodes.end(), anchor.nodes.begin(), anchor.nodes.end());
  return nodes;
}

}  // namespace springlod::sim
