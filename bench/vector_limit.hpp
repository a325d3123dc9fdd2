#pragma once

namespace springlod::bench {

enum class Vectors { best, avx2 };

/// Whether this processor supports more than AVX2.
bool has_more_than_avx2();

/// Limits kernels to these vector instructions for its lifetime.
class VectorLimit {
 public:
  explicit VectorLimit(Vectors vectors);
  ~VectorLimit();
  VectorLimit(const VectorLimit&) = delete;
  VectorLimit& operator=(const VectorLimit&) = delete;
};

}  // namespace springlod::bench
