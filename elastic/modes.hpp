#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/option.hpp"
#include "base/progress.hpp"
#include "elastic/elastic_body.hpp"
#include "model/mass_spring.hpp"

namespace springlod::elastic {

struct ModeOptions {
  std::uint32_t count = 20;  ///< requested modes; fewer are returned if the model has fewer
  /// Upper bound of the relative error of the squared frequencies. The true error of a frequency is
  /// about the square of it.
  double accuracy = 1e-4;
  std::uint64_t seed = 1;        ///< of the start vectors
  Progress* progress = nullptr;  ///< may be null
  /// Approximate shapes of the lowest modes, N vectors each, in the unit of Mode::shape. They make
  /// the iteration shorter and change nothing else.
  std::span<const std::vector<Vec3>> start = {};
};
constexpr auto option_rows(const ModeOptions*) {
  return std::tuple(
      option("count", &ModeOptions::count, "number of modes; zero modes are not counted")
          .within(1, 1e6),
      option("accuracy", &ModeOptions::accuracy,
             "bound of the relative error of each squared frequency")
          .within(1e-12, 0.1),
      option("seed", &ModeOptions::seed, "seed of the start vectors"));
}

/// A mode of vibration about rest. Anchored nodes do not move in it.
struct Mode {
  double angular_frequency = 0;  ///< omega [rad/s]
  /// Bound of the relative error of omega^2 (docs/method.md, eq. 14): the residual of the shifted
  /// inverse, |(D + sigma)^-1 y - theta y| / theta, for the mass-weighted shape y. For small
  /// components, which a dense solver handles: |D y - omega^2 y| / omega^2.
  double residual = 0;
  /// N; mass-normalised: sum m |shape|^2 = 1 [kg^-1/2]. Shapes are orthogonal within the accuracy.
  /// The sign is arbitrary; so is the basis of the shapes of a multiple frequency.
  std::vector<Vec3> shape;

  double frequency() const;  ///< [Hz]
};

struct Modes {
  std::vector<Mode> modes;  ///< from the lowest frequency up
  /// Rigid motions (6 for a solid component, none for a well anchored one) and mechanisms.
  std::uint32_t zero_modes_skipped = 0;
};

/// The lowest modes of M^-1 K without zero modes; multiple frequencies are repeated
/// (docs/method.md, eqs. 12 to 14). Block Lanczos iteration (Grimes, Lewis & Simon 1994) on the
/// shifted inverse of each connected component, with the zero modes projected out; small components
/// by a dense solver. If more than 8 modes of one component share a frequency, some of them may be
/// missed.
///
/// Cost of 20 modes of 20k nodes: some 8 s, of which 4.5 s are the factorisation.
///
/// Throws InputError for a count of 0, an accuracy outside 1e-12..0.1, an iteration that does not
/// converge, and where elastic_body does.
Modes lowest_modes(const MassSpringModel& model, const ModeOptions& options = {});
/// The same for a model that is factorised already, which may have anchored nodes.
Modes lowest_modes(const ElasticBody& body, const ModeOptions& options = {});

}  // namespace springlod::elastic
