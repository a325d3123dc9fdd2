#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "report/export/export.hpp"

namespace springlod::report {

/// A body as engines with y up and single precision take it: (x, y, z) becomes (x, z, -y).
struct SingleBody {
  std::array<float, 3> center{};    ///< of the bounds [m]; positions are relative to it
  float extent = 0;                 ///< largest coordinate of a position [m]
  std::vector<float> position;      ///< 3 N [m]
  std::vector<float> mass;          ///< N [kg]
  std::vector<std::uint32_t> ends;  ///< 2 S
  std::vector<float> rest_length;   ///< S [m]
  std::vector<float> stiffness;     ///< S [N/m]
  // The skin: vertices as weights of nodes, compressed rows; empty without a surface.
  std::vector<std::uint32_t> skin_start, skin_node;
  std::vector<float> skin_weight;
  std::vector<std::uint32_t> triangles;  ///< 3 a triangle

  bool has_skin() const { return !triangles.empty(); }
};
SingleBody single_body(const ExportedModel& body);

/// The same direction or acceleration in those axes.
std::array<float, 3> y_up(const Vec3& vector);

/// Numbers with commas between them, in lines of at most 100 columns. Singles are written with as
/// many digits as give them back, in C++ with an F.
std::string list(std::span<const float> values, bool cpp);
std::string list(std::span<const std::uint32_t> values);

/// C++ arrays of a body, in a namespace that the caller opens: kNodes, kPosition, kMass, kSprings,
/// kEnds, kRestLength, kStiffness, and those of the skin, with a function that places it.
std::string cpp_arrays(const SingleBody& body);

}  // namespace springlod::report
