#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The materials of a grid in the making: one entry a name, numbered in the order of first use.
class MaterialChoice {
 public:
  /// Throws InputError: a material is out of range, or two that differ share a name.
  explicit MaterialChoice(const VoxelizeOptions& options);

  /// Of a part by its name, else by the file's material name, else the fallback.
  std::uint16_t of_part(const MeshPart& part);
  std::uint16_t of_core();
  /// By the name a paint function gave: a material's own or its key in the options. Throws
  /// InputError listing the names.
  std::uint16_t of_name(const std::string& name);

  const std::string& name(std::uint16_t number) const { return list_[number].name; }
  /// Keys of options.materials that nothing asked for.
  std::vector<std::string> unused() const;
  /// The materials that cells have; renumbers the cells.
  std::vector<Material> finish(std::vector<std::uint16_t>& material_of_cell) const;

 private:
  std::uint16_t number_of(const Material& material);

  std::map<std::string, Material> by_key_;
  Material fallback_;
  std::optional<Material> core_;
  std::vector<Material> list_;
  std::set<std::string> asked_;
};

}  // namespace springlod::voxelize
