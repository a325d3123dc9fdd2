#include "sim/starts.hpp"

#include <random>

namespace springlod {

Throw jittered(const Throw& start, const Vec3& center, double jitter, std::uint64_t seed,
               std::uint32_t index) {
  if (index == 0) return start;
  Throw changed = start;
  changed.position = start.placed ? start.position : center;
  changed.placed = true;
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         index};
  std::mt19937_64 random(sequence);
  const auto factor = [&] {
    const double unit = static_cast<double>(random() >> 11U) * 0x1p-53;  // [0, 1)
    return 1 + jitter * (2 * unit - 1);
  };
  changed.velocity *= factor();
  changed.position.z() *= factor();
  return changed;
}

}  // namespace springlod
