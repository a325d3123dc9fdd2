#pragma once

#include <memory>

#include "model/mass_spring.hpp"
#include "sim/fast/fast_body.hpp"
#include "sim/fast/layout.hpp"
#include "sim/fast/vector_target.hpp"

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

}  // namespace springlod::sim
