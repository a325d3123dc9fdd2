#pragma once

#include "model/vec.hpp"

namespace springlod::sim {

/// A Vec3 padded by a 0, which the vector units of a processor take as a whole.
using Padded = Eigen::Vector4d;

inline Padded padded(const Vec3& v) {
  return {v[0], v[1], v[2], 0};
}

/// Adds up in the order of Vec3::dot().
inline double dot(const Padded& a, const Padded& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

inline Padded cross(const Padded& a, const Padded& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
}

}  // namespace springlod::sim
