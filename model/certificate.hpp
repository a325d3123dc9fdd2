#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace springlod::inline model {

/// Number of lowest modes over which a certificate averages; they carry most of a motion.
inline constexpr std::size_t kLowestModes = 10;

/// Measured properties of a level beside those of its base, stored with it in the asset
/// (docs/method.md, section 6). Relative errors are level / base - 1. All values are those of the
/// model linearized about rest.
struct Certificate {
  /// Moduli of a material from its average stress and strain under the smooth loads
  /// (docs/method.md, eqs. 9 and 10).
  struct Moduli {
    std::string material;
    double young = 0, base_young = 0;      ///< [Pa]
    double poisson = 0, base_poisson = 0;  ///< [1]
  };
  struct Frequency {
    double level = 0, base = 0;  ///< [Hz]
    /// Modal assurance criterion 0..1 (docs/method.md, eq. 49): the fraction of the level's mode
    /// within the base's modes of this frequency, plus or minus 5 %.
    double mac = 0;
    double decay = 0, base_decay = 0;  ///< rate at which damping makes the amplitude fall [1/s]
  };
  struct Load {
    std::string name;
    bool held_out = false;  ///< on patches that no calibration uses
    double compliance = 0;  ///< of the means of the base over the groups of the level, f.u [J]
    double error = 0;       ///< relative error of the compliance [1]
  };

  std::vector<Moduli> moduli;
  std::vector<Frequency> frequencies;  ///< the lowest ones, ascending
  std::vector<Load> loads;
  double mass_error = 0;           ///< [1]
  double center_shift = 0;         ///< of the centre of mass, over the radius of gyration [1]
  double second_moment_error = 0;  ///< largest entry of the tensor's error / largest entry [1]
  double highest_frequency = 0, base_highest_frequency = 0;  ///< omega_max [rad/s]
  double stable_step = 0, base_stable_step = 0;              ///< [s]
  /// Number of springs / stable time step: the work for a simulated second [1/s].
  double cost = 0, base_cost = 0;
  std::uint32_t zero_modes = 0, expected_zero_modes = 0;
  /// Errors of motions that the lowest modes of the base make up, empty in assets of earlier
  /// versions (docs/method.md, eqs. 50a and 50b): of the velocities right after a blow, and of the
  /// displacements in the first period of free vibration [1].
  std::optional<double> blow_error, first_period_error;
  /// Largest contact area over mass of a node of the level over that of the base [1], which raises
  /// the frequency of its contacts. Empty without contact area, and in assets of earlier versions.
  std::optional<double> contact_ratio;
  /// Requested bound of the mean error of the ten lowest frequencies [1]; 0: none was requested.
  double tolerance = 0;
  /// Descriptions of what exceeds the requested bound.
  std::vector<std::string> unmet;
};

/// Throws InputError for a value that is not finite, for a frequency, step or cost below 0, and for
/// a frequency of the base that is not above 0 (errors are relative to it).
void validate(const Certificate& certificate);

/// Mean |error| of the frequencies first .. last-1, counted from 0; missing frequencies are
/// skipped; 0 without any.
double mean_frequency_error(const Certificate& certificate, std::uint32_t first,
                            std::uint32_t last);
/// Mean MAC of the ten lowest modes; empty without any.
std::optional<double> mean_mac(const Certificate& certificate);
/// Mean |error| of the decay rates of the ten lowest modes; empty if the base has no damping.
std::optional<double> mean_decay_error(const Certificate& certificate);
/// Mean |error| of the loads that were, or were not, held out of the calibration; 0
/// without any.
double mean_load_error(const Certificate& certificate, bool held_out);

}  // namespace springlod::inline model
