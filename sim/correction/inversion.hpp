#pragma once

#include <cstdint>
#include <optional>

#include "model/corners.hpp"
#include "model/vec.hpp"

namespace springlod::sim {

/// A corner that was found inside out (J <= 0).
struct Inversion {
  std::uint32_t corner = 0;   ///< number in the model
  Vec3 place = Vec3::Zero();  ///< position of the corner's node [m]
  double time = 0;            ///< [s]
};

/// The inversions of a run: the corners inside out at the end of any step. One that others turned
/// over in the last step, and that turns back in the next, is not seen.
struct Inversions {
  std::optional<Inversion> first;
  std::uint32_t most = 0;  ///< largest number of corners inside out at one time
};

}  // namespace springlod::sim
