#pragma once

#include <string>

#include "base/range.hpp"

namespace springlod::inline model {

/// Values of a physical quantity that a model may have. The ranges go from cells of a nanometre to
/// a planet, and from a gel to diamond with orders of magnitude to spare, so they refuse no
/// sensible body. A damaged file soon has a value outside of them: products of such values
/// overflow, and steps that resolve them never end.
struct PhysicalRange : Range {
  const char* unit;
};

namespace range {

/// Coordinates: those of a planet, 1e7 m, with a resolution of 1e-7 m in double precision.
inline constexpr PhysicalRange kCoordinate{{-1e9, 1e9}, "m"};
/// Below the distance of atoms, above the diagonal of all coordinates.
inline constexpr PhysicalRange kRestLength{{1e-12, 1e10}, "m"};
/// A node of 1 nm3 of water has 1e-24 kg; a planet has 1e25 kg.
inline constexpr PhysicalRange kMass{{1e-27, 1e27}, "kg"};
inline constexpr PhysicalRange kVolume{{1e-30, 1e24}, "m3"};
/// k is about E h: 1 Pa and 1 nm give 1e-9 N/m, 1e12 Pa and 1e6 m give 1e18 N/m.
inline constexpr PhysicalRange kStiffness{{1e-15, 1e21}, "N/m"};
/// Soft gels have 1 Pa, diamond has 1e12 Pa.
inline constexpr PhysicalRange kYoung{{1e-6, 1e15}, "Pa"};
/// Gases have 1 kg/m3, osmium has 2e4 kg/m3.
inline constexpr PhysicalRange kDensity{{1e-6, 1e9}, "kg/m3"};
/// c/k of a material or spring. Glaciers creep within 1e5 s.
inline constexpr PhysicalRange kDampingTime{{0, 1e6}, "s"};
/// Poisson's ratio. Few solids have less than 0; at 0.5, nothing changes its volume, and no
/// explicit step is stable.
inline constexpr PhysicalRange kPoisson{{-0.2, 0.495}, ""};
/// Lambda V of a dilatation term: 1e-3 Pa in 1 nm3 to 1e15 Pa in 1e15 m3.
inline constexpr PhysicalRange kDilatation{{1e-36, 1e30}, "J"};
/// Gradient of a node in a dilatation term: the inverse of a length.
inline constexpr PhysicalRange kGradient{{-1e12, 1e12}, "1/m"};
/// Components of a colour.
inline constexpr PhysicalRange kColour{{0, 1}, ""};

/// Rest length over the distance of the ends at rest [1]: a spring compressed to 1 % of its length.
inline constexpr double kMostCompression = 100;
/// Contact area over V^(2/3) of a node [1]. A cube of six free faces has 6; a group of m cells of a
/// sheet one cell thick has 6 m^(1/3), and cells are at most 2^32.
inline constexpr double kMostFolding = 1e5;

}  // namespace range

/// "its mass is 1e+300 kg; it must lie between 1e-27 and 1e+27 kg".
std::string outside(const char* quantity, double value, const PhysicalRange& range);

}  // namespace springlod::inline model
