#pragma once

#include <cstdint>

#include "model/vec.hpp"

namespace springlod::lod {

/// How a node is held by its springs: their number and sum k u u^T, a symmetric tensor [N/m].
class Rigidity {
 public:
  /// A spring along `d` [m] of tension k |d| [N]; one of no length counts but holds nothing.
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
  /// Whether lambda_min is at least `ratio` times lambda_max; 0 is at least 0 (no springs).
  bool at_least(double ratio) const;

 private:
  bool surely_at_least(double ratio) const;
  double xx_ = 0, yx_ = 0, yy_ = 0, zx_ = 0, zy_ = 0, zz_ = 0;
  std::uint32_t springs_ = 0;
};

}  // namespace springlod::lod
