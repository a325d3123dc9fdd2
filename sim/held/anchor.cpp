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

void validate_spring(const Anchor& anchor) {
  if (!anchor.spring) return;
  if (!(anchor.spring->stiffness > 0 && std::isfinite(anchor.spring->stiffness)))
    throw InputError(
        fmt::format("anchor \"{}\": its stiffness of {} N/m must be finite and above 0",
                    anchor.name, anchor.spring->stiffness));
  if (!(anchor.spring->damping >= 0 && std::isfinite(anchor.spring->damping)))
    throw InputError(
        fmt::format("anchor \"{}\": its damping time of {} s must be finite and not below 0",
                    anchor.name, anchor.spring->damping));
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
    validate_spring(anchor);
  }
}

std::vector<Anchor> mapped(const std::vector<Anchor>& anchors, const Groups& of_base) {
  std::vector<Anchor> of_level = anchors;
  for (Anchor& anchor : of_level) anchor.nodes = mapped_nodes(of_base, anchor.nodes);
  return of_level;
}

std::vector<double> shared_stiffness(const Anchor& anchor, const MassSpringModel& model) {
  const std::vector<std::uint8_t> flags = anchor_flags(model, anchor.nodes);
  double mass = 0;
  for (std::uint32_t i = 0; i < flags.size(); ++i)
    if (flags[i] != 0) mass += model.mass[i];
  std::vector<double> stiffness;
  for (std::uint32_t i = 0; i < flags.size(); ++i)
    if (flags[i] != 0) stiffness.push_back(anchor.spring->stiffness * model.mass[i] / mass);
  return stiffness;
}

Support support_of(const std::vector<Anchor>& anchors, const MassSpringModel& model) {
  Support support;
  for (const Anchor& anchor : anchors) {
    if (!anchor.spring) {
      support.nodes.insert(support.nodes.end(), anchor.nodes.begin(), anchor.nodes.end());
      continue;
    }
    const std::vector<std::uint8_t> flags = anchor_flags(model, anchor.nodes);
    const std::vector<double> stiffness = shared_stiffness(anchor, model);
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < flags.size(); ++i)
      if (flags[i] != 0) support.springs.push_back({i, stiffness[next++]});
  }
  return support;
}

std::vector<std::uint32_t> nodes_of(const std::vector<Anchor>& anchors) {
  std::vector<std::uint32_t> nodes;
  for (const Anchor& anchor : anchors)
    nodes.insert(nodes.end(), anchor.nodes.begin(), anchor.nodes.end());
  return nodes;
}

}  // namespace springlod::sim
