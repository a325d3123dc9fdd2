#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace springlod::elastic {

/// Uniform numbers in [-0.5, 0.5), the same with every standard library: start vectors of
/// iterations.
inline Eigen::MatrixXd random_block(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Eigen::MatrixXd block(rows, columns);
  for (Eigen::Index c = 0; c < columns; ++c)
    for (Eigen::Index r = 0; r < rows; ++r)
      block(r, c) = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
  return block;
}

}  // namespace springlod::elastic
