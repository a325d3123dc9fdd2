#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace springlod::render {

/// 8-bit RGB, rows from the top, no padding.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;
};

/// An OSMesa core-profile context of fixed size with a 4-sample render target; the only user of
/// OSMesa. Not thread-safe. Throws InputError if a side exceeds the maximum.
class OffscreenContext {
 public:
  OffscreenContext(std::uint32_t width, std::uint32_t height);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  std::uint32_t width() const;
  std::uint32_t height() const;
  /// Makes the multisampled target current.
  void begin();
  /// Resolves the samples and reads the image back.
  Image finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace springlod::render
