#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "model/material_input.hpp"
#include "model/mesh.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Collects the materials of a grid: one entry for each name, numbered in the order of first use.
class MaterialChoice {
 public:
  /// Throws InputError for a material out of range, and for different materials of one name.
  explicit MaterialChoice(const VoxelizeOptions& options);

  /// The material of a part: by its name, else by its material name in the file, else the fallback.
  std::uint16_t of_part(const MeshPart& part);
  std::uint16_t of_core();
  /// The material of a name that a paint function returned: a material's own name or its key in the
  /// options. Throws InputError with the list of names.
  std::uint16_t of_name(const std::string& name);

  const std::string& name(std::uint16_t number) const { return list_[number].material.name; }
  /// Keys of options.materials that were never used.
  std::vector<std::string> unused() const;
  /// The materials that occur in cells; renumbers the cells.
  std::vector<MaterialInput> finish(std::vector<std::uint16_t>& material_of_cell) const;

 private:
  std::uint16_t number_of(const MaterialInput& input);

  std::map<std::string, MaterialInput> by_key_;
  MaterialInput fallback_;
  std::optional<MaterialInput> core_;
  std::vector<MaterialInput> list_;
  std::set<std::string> used_keys_;
};

}  // namespace springlod::voxelize
