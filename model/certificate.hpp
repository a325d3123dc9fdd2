#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace springlod::inline model {

/// What a level is measured to be beside its base: kept with it in the asset. Relative errors are
/// level over base minus 1, all at rest and to first order.
struct Certificate {
  /// Averages of stress over averages of strain within one material, under the smooth loads.
  struct Moduli {
    std::string material;
    double young = 0, base_young = 0;      ///< [Pa]
    double poisson = 0, base_poisson = 0;  ///< [1]
  };
  struct Frequency {
    double level = 0, base = 0;  ///< [Hz]
    /// Modal assurance criterion 0..1: how much of the level's mode lies in those of the base that
    /// have this frequency, within 5 %.
    double mac = 0;
  };
  struct Load {
    std::string name;
    bool held_out = false;  ///< of a kind that calibration is never fitted to
    double compliance = 0;  ///< of the base [J]
    double error = 0;       ///< of the compliance [1]
  };

  std::vector<Moduli> moduli;
  std::vector<Frequency> frequencies;  ///< the lowest ones, rising
  std::vector<Load> loads;
  double mass_error = 0;           ///< [1]
  double center_shift = 0;         ///< of the centre of mass, over the radius of gyration [1]
  double second_moment_error = 0;  ///< largest of the tensor's entries, over its largest [1]
  double highest_frequency = 0, base_highest_frequency = 0;  ///< omega_max [rad/s]
  double stable_step = 0, base_stable_step = 0;              ///< [s]
  /// Springs over the stable step: what a simulated second takes [1/s].
  double cost = 0, base_cost = 0;
  std::uint32_t zero_modes = 0, expected_zero_modes = 0;
  /// Mean error of the ten lowest frequencies that was asked for [1].
  double tolerance = 0;
  /// What of it was not reached, in words; empty: the level is what was asked for.
  std::vector<std::string> misses;
};

/// Throws InputError for a number that is not finite, or a frequency of the base that is not above
/// 0 (errors are relative to it).
void validate(const Certificate& certificate);

/// Mean |error| of the frequencies first..last-1, counted from 0; of those there are.
double mean_frequency_error(const Certificate& certificate, std::uint32_t first,
                            std::uint32_t last);
/// Mean |error| of the loads that were, or were not, held out.
double mean_load_error(const Certificate& certificate, bool held_out);

}  // namespace springlod::inline model
