#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/option.hpp"
#include "model/binding.hpp"
#include "model/chain.hpp"
#include "report/animate.hpp"
#include "sim/scenario.hpp"

namespace springlod::report {

// What a viewer needs to draw and play levels in 3D, small enough for a page that is sent round.

struct ViewOptions {
  std::uint32_t frames = 90;  ///< at most, evenly spaced over the longest run
  /// The surface is coarsened to at most as many triangles.
  std::uint32_t triangles = 20000;
  /// Size of the data as text (base64) [B]. Frames, springs and the finest levels are left out if
  /// they do not fit.
  double bytes = 2.5e6;
};
constexpr auto option_rows(const ViewOptions*) {
  using Options = ViewOptions;
  return std::tuple(
      option("frames", &Options::frames, "most frames of the motion").within(1, 1e4),
      option("triangles", &Options::triangles, "most triangles of the surface").within(4, 1e7),
      option("bytes", &Options::bytes,
             "most bytes of text: frames, springs and the finest levels that do not fit are left "
             "out")
          .within(1, 1e9));
}

/// One level and its motion.
struct ViewBody {
  std::string label;                               ///< "base", "hb level 1"
  std::uint32_t chain = 0;                         ///< number of its comparison
  std::uint32_t level = 0;                         ///< in its chain
  std::uint32_t springs = 0;                       ///< number of springs, whether listed or not
  std::vector<std::array<std::uint32_t, 2>> ends;  ///< nodes of each spring; empty if left out
  std::vector<std::uint32_t> colour;               ///< of each node: index into View::palette
  Binding to_base;  ///< from its nodes to those of the base; empty for level 0 and without surface
  std::vector<std::vector<Vec3>> frames;  ///< positions of its nodes at each of View::times [m]
};

struct View {
  std::vector<double> times;  ///< [s], ascending; {0} for levels at rest
  std::vector<Colour> palette;
  std::vector<ViewBody> bodies;     ///< the base first, then each chain from fine to coarse
  std::vector<Triangle> triangles;  ///< empty without a surface
  std::vector<std::uint32_t> vertex_colour;  ///< index into palette
  Binding surface;                           ///< from the base's nodes to the surface's vertices
  std::vector<sim::Obstacle> obstacles;
  std::vector<std::string> left_out;  ///< what is not as asked, one sentence each
};

/// The levels of a chain at rest. Throws InputError if none of them fits.
View view_of(const LodAsset& asset, const ViewOptions& options = {});

/// The runs of one or more comparisons in one scenario, of chains with one base (which is shown
/// once). Throws InputError if a comparison has no runs or frames, the bases differ, or none of the
/// levels fits.
View view_of(const std::vector<ComparedChain>& chains, const ViewOptions& options = {});

}  // namespace springlod::report
