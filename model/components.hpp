#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// A connected component of a model as a separate model.
struct ModelComponent {
  MassSpringModel model;
  std::vector<std::uint32_t> nodes;    ///< number of each node in the whole model, ascending
  std::vector<std::uint32_t> springs;  ///< number of each spring in the whole model, ascending
  std::vector<std::uint32_t> terms;    ///< number of each dilatation term, ascending
};

/// Splits a model into its connected components. `components` is connected_components(model).
std::vector<ModelComponent> split_components(const MassSpringModel& model,
                                             const Components& components);

}  // namespace springlod::inline model
