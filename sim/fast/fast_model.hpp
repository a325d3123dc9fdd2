#pragma once

#include <memory>

#include "model/mass_spring.hpp"
#include "sim/fast/fast_body.hpp"
#include "sim/fast/layout.hpp"

namespace springlod::sim {

/// A model in a fast layout, made once and shared by its bodies.
class FastModel {
 public:
  virtual ~FastModel() = default;
  FastModel(const FastModel&) = delete;
  FastModel& operator=(const FastModel&) = delete;

  /// A body whose positions and velocities are not set yet. It must not outlive the model. With
  /// damping, it provides damping_power().
  virtual std::unique_ptr<FastBody> new_body(bool with_damping) const = 0;

 protected:
  FastModel() = default;
};

/// `model` must be valid.
std::unique_ptr<FastModel> make_fast_model(const MassSpringModel& model, Precision precision,
                                           Layout layout = Layout::fastest);

/// Vector instruction set of the kernels on this processor: "AVX3", "AVX2", ...
const char* vector_target();

}  // namespace springlod::sim
