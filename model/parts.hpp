#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// One connected part of a model as a model of its own.
struct ModelPart {
  MassSpringModel model;
  std::vector<std::uint32_t> nodes;    ///< of the whole: that of each node of the part, rising
  std::vector<std::uint32_t> springs;  ///< of the whole: that of each spring of the part, rising
};

/// The connected parts, as `components` (connected_components of `model`) numbers them: by their
/// lowest node.
std::vector<ModelPart> split_parts(const MassSpringModel& model, const Components& components);

}  // namespace springlod::inline model
