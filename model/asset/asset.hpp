#pragma once

#include <filesystem>

#include "model/chain.hpp"

namespace springlod::inline model {

/// Writes a chain as one binary glTF 2.0 file: per level a node with a POINTS and a LINES
/// primitive that any viewer shows (single precision; _MASS and the like as custom attributes),
/// the surface mesh, and, in the extension SPRINGLOD_lod_chain (docs/asset-format.md), everything
/// exact in doubles with a checksum. Written aside and renamed; the same asset gives the same
/// bytes. In names that are not UTF-8 the odd bytes are replaced by U+FFFD. Throws IoError, and
/// InputError for an asset that does not validate.
void save_asset(const LodAsset& asset, const std::filesystem::path& path);

/// Reads back what save_asset wrote, bit for bit. Throws IoError (no such file, no springlod
/// asset, damaged: the checksum differs, newer version).
LodAsset load_asset(const std::filesystem::path& path);

}  // namespace springlod::inline model
