#pragma once

namespace springlod::bench {

enum class Vectors { best, avx2 };

/// Whether there is something better than AVX2 here to be kept from.
bool has_more_than_avx2();

/// As long as it lives, kernels move with these vectors.
class VectorLimit {
 public:
  explicit VectorLimit(Vectors vectors);
  ~VectorLimit();
  VectorLimit(const VectorLimit&) = delete;
  VectorLimit& operator=(const VectorLimit&) = delete;
};

}  // namespace springlod::bench
