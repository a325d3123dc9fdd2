#pragma once

#include <cstdint>

#include "model/vec.hpp"

namespace springlod::lod {

/// Stiffness of a node with its neighbours held: the number of its springs and the symmetric tensor
/// A = sum k u u^T [N/m].
class Rigidity {
 public:
  /// Adds a spring along `d` [m] with k |d| = `tension` [N]. A spring of length 0 is counted but
  /// adds no stiffness.
  void add_spring(const Vec3& d, double tension) {
    ++springs_;
    const double length = d.norm();
    if (!(length > 0)) return;
    const Vec3 pull = tension / (length * length * length) * d;
    xx_ += pull.x() * d.x();
    yx_ += pull.y() * d.x();
    zx_ += pull.z() * d.x();
    yy_ += pull.y() * d.y();
    zy_ += pull.z() * d.y();
    zz_ += pull.z() * d.z();
  }

  std::uint32_t springs() const { return springs_; }
  /// Whether lambda_min(A) >= `ratio` lambda_max(A); true without springs, where both are 0.
  bool at_least(double ratio) const;

 private:
  bool surely_at_least(double ratio) const;
  double xx_ = 0, yx_ = 0, yy_ = 0, zx_ = 0, zy_ = 0, zz_ = 0;
  std::uint32_t springs_ = 0;
};

}  // namespace springlod::lod
