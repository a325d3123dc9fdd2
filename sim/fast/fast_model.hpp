#pragma once

#include <memory>

#include "model/mass_spring.hpp"
#include "sim/fast/fast_body.hpp"
#include "sim/fast/layout.hpp"

namespace springlod::sim {

/// A model in a fast memory layout, built once and shared by its bodies.
class FastModel {
 public:
  virtual ~FastModel() = default;
  FastModel(const FastModel&) = delete;
  FastModel& operator=(const FastModel&) = delete;

  /// The caller must set its positions and velocities. Must not outlive the model. With damping, it
  /// computes damping_power.
  virtual std::unique_ptr<FastBody> new_body(bool with_damping) const = 0;

 protected:
  FastModel() = default;
};

/// `model` must be valid.
std::unique_ptr<FastModel> make_fast_model(const MassSpringModel& model, Precision precision,
                                           Layout layout = Layout::fastest);

/// "AVX3", "AVX2", ...: the SIMD instruction set used on this processor.
const char* vector_target();

}  // namespace springlod::sim
