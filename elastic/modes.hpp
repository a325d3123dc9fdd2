#pragma once

#include <cstdint>
#include <vector>

#include "base/option.hpp"
#include "base/progress.hpp"
#include "elastic/elastic_body.hpp"
#include "model/mass_spring.hpp"

namespace springlod::elastic {

struct ModeOptions {
  std::uint32_t count = 20;  ///< modes wanted; fewer come back if the model has fewer
  /// Relative accuracy of the squared frequencies, as an upper bound; what the frequencies really
  /// miss by is about the square of it.
  double accuracy = 1e-4;
  std::uint64_t seed = 1;        ///< of the start vectors
  Progress* progress = nullptr;  ///< may be null
};
constexpr auto option_rows(const ModeOptions*) {
  return std::tuple(option("count", &ModeOptions::count,
                           "modes wanted; motions that no spring resists are not among them"),
                    option("accuracy", &ModeOptions::accuracy,
                           "bound of the relative error of each squared frequency"),
                    option("seed", &ModeOptions::seed, "of the start of the iteration"));
}

/// One way in which a body swings about rest; anchored nodes do not move in it.
struct Mode {
  double angular_frequency = 0;  ///< omega [rad/s]
  /// A bound of the relative error of omega^2: the residual of the shifted inverse,
  /// |(D + sigma)^-1 y - theta y| / theta for the shape y in mass-weighted unknowns (of small
  /// parts, solved for densely, |D y - omega^2 y| / omega^2).
  double residual = 0;
  /// N; mass-normalised: sum m |shape|^2 = 1 [kg^-1/2]. Orthogonal to the other shapes to the
  /// accuracy; its sign and, of a frequency that several share, its direction mean nothing.
  std::vector<Vec3> shape;

  double frequency() const;  ///< [Hz]
};

struct Modes {
  std::vector<Mode> modes;  ///< from the lowest frequency up
  /// Rigid motions (6 for a solid part, none for a well anchored one) and mechanisms.
  std::uint32_t zero_modes_skipped = 0;
};

/// The lowest modes of M^-1 K that springs resist, each as often as it occurs. Block Lanczos
/// iteration (Grimes, Lewis & Simon 1994) on the shifted inverse with the zero modes taken out,
/// part by part; small parts by a dense solver. A frequency that more than 8 modes of one connected
/// part share may be found too seldom.
///
/// 20k nodes, 20 modes: some 8 s, of which 4.5 are the factorisation.
/// Throws InputError for a count of 0, an accuracy outside 1e-12..0.1, should the iteration not
/// converge, and where elastic_body does.
Modes lowest_modes(const MassSpringModel& model, const ModeOptions& options = {});
/// Of a model that is factorised already; so are those with anchored nodes.
Modes lowest_modes(const ElasticBody& body, const ModeOptions& options = {});

}  // namespace springlod::elastic
