#pragma once

// Constants shared by the writer and the reader (docs/asset-format.md).

#include <bit>
#include <cstdint>
#include <type_traits>

#include "model/vec.hpp"

namespace springlod::inline model::asset_format {

static_assert(std::endian::native == std::endian::little,
              "arrays are copied from memory, and glTF is little-endian");

/// The numbers that an entry of an array consists of: integers, or coordinates.
template <class T>
using ScalarOf =
    std::conditional_t<sizeof(T) == 1, std::uint8_t,
                       std::conditional_t<std::is_same_v<T, double> || std::is_same_v<T, Vec3>,
                                          double, std::uint32_t>>;
/// How many they are.
template <class T>
inline constexpr std::size_t kWidthOf = sizeof(T) / sizeof(ScalarOf<T>);

inline constexpr const char* kExtension = "SPRINGLOD_lod_chain";
/// That of all written assets.
inline constexpr int kVersion = 6;
/// The first version whose levels have corners.
inline constexpr int kVersionWithCorners = 2;
/// The first version whose materials have a Poisson's ratio and whose levels have dilatation terms.
inline constexpr int kVersionWithDilatation = 3;
/// The first version whose base may have a contact surface.
inline constexpr int kVersionWithSurface = 4;
/// The first version with slim assets, whose arrays are objects that state their type.
inline constexpr int kVersionWithSlim = 5;
/// The first version whose checksum is a CRC-32 of the whole file, and in which the arrays of all
/// assets are objects.
inline constexpr int kVersionWithCrc = 6;

}  // namespace springlod::inline model::asset_format
