#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "model/binding.hpp"
#include "model/chain.hpp"

namespace springlod::inline model {

/// Writes a chain as one binary glTF 2.0 file (docs/asset-format.md). It has two descriptions of
/// the chain: for any glTF viewer the surface mesh and, for each level, a node with a POINTS and a
/// LINES primitive (single precision; _MASS and others as custom attributes); and, in the extension
/// SPRINGLOD_lod_chain, all arrays in double precision with a checksum.
///
/// The file is written under a temporary name and then renamed. The same asset gives the same
/// bytes. In names that are not UTF-8, invalid bytes are replaced by U+FFFD. Throws IoError, and
/// InputError for an asset that does not validate.
void save_asset(const LodAsset& asset, const std::filesystem::path& path);

/// What a slim asset has of a level that an asset does not have.
struct SlimLevel {
  Binding of_level;        ///< maps the level's nodes to those of level 0; empty for level 0
  double stable_step = 0;  ///< of explicit integration [s]
};

/// Writes what an engine needs to run and to show the levels, in a third of the bytes: slimmed()
/// (asset/slim_asset.hpp) in arrays of small types, and as glTF scene only the surface or, without
/// one, the nodes and springs of level 0. `levels`: one for each level of the asset. Throws as
/// save_asset does, and InputError as slimmed() does.
void save_slim_asset(const LodAsset& asset, const std::vector<SlimLevel>& levels,
                     const std::filesystem::path& path);

/// Reads a file of save_asset or save_slim_asset; all values keep their bits. Throws IoError for a
/// missing file, a file that is not a springlod asset, a damaged file and a newer version. Sizes
/// and counts are checked before memory is allocated, then the checksum, then the rules and ranges
/// of validate().
LodAsset load_asset(const std::filesystem::path& path);
/// As load_asset, from the bytes of a file. `name` is that of the file in messages.
LodAsset parse_asset(std::string_view file, const std::string& name);

}  // namespace springlod::inline model
