#include "voxelize/cells/material_choice.hpp"

#include <limits>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::voxelize {

MaterialChoice::MaterialChoice(const VoxelizeOptions& options)
    : by_key_(options.materials), fallback_(options.fallback) {
  if (options.core_shell) core_ = options.core_shell->core;
  std::map<std::string, const MaterialInput*> seen;
  const auto check = [&](const MaterialInput& input) {
    validate(input);
    const auto [at, is_new] = seen.try_emplace(input.material.name, &input);
    if (!is_new && !(*at->second == input))
      throw InputError(fmt::format(
          "voxelize: two different materials have the name \"{}\"; give each its own name",
          input.material.name));
  };
  for (auto& [key, input] : by_key_) {
    if (input.material.name.empty()) input.material.name = key;
    check(input);
  }
  check(fallback_);
  if (core_) check(*core_);
}

std::uint16_t MaterialChoice::number_of(const MaterialInput& input) {
  for (std::size_t n = 0; n < list_.size(); ++n)
    if (list_[n].material.name == input.material.name) return static_cast<std::uint16_t>(n);
  if (list_.size() > std::numeric_limits<std::uint16_t>::max())
    throw InputError("voxelize: more than 65536 materials; let parts share some");
  list_.push_back(input);
  return static_cast<std::uint16_t>(list_.size() - 1);
}

std::uint16_t MaterialChoice::of_part(const MeshPart& part) {
  for (const std::string& key : {part.name, part.material}) {
    const auto at = by_key_.find(key);
    if (at == by_key_.end()) continue;
    used_keys_.insert(key);
    return number_of(at->second);
  }
  return number_of(fallback_);
}

std::uint16_t MaterialChoice::of_core() {
  return number_of(*core_);
}

std::uint16_t MaterialChoice::of_name(const std::string& name) {
  std::string known;
  for (const auto& [key, input] : by_key_) {
    if (key == name || input.material.name == name) {
      used_keys_.insert(key);
      return number_of(input);
    }
    known += fmt::format("\"{}\", ", key);
  }
  if (core_ && core_->material.name == name) return of_core();
  if (fallback_.material.name == name) return number_of(fallback_);
  if (core_) known += fmt::format("\"{}\", ", core_->material.name);
  throw InputError(
      fmt::format("voxelize: paint returned \"{}\", which is not a material; use one of {}\"{}\"",
                  name, known, fallback_.material.name));
}

std::vector<std::string> MaterialChoice::unused() const {
  std::vector<std::string> keys;
  for (const auto& [key, input] : by_key_)
    if (!used_keys_.contains(key)) keys.push_back(key);
  return keys;
}

std::vector<MaterialInput> MaterialChoice::finish(
    std::vector<std::uint16_t>& material_of_cell) const {
  std::vector<std::uint8_t> used(list_.size(), 0);
  for (const std::uint16_t number : material_of_cell) used[number] = 1;
  std::vector<MaterialInput> kept;
  std::vector<std::uint16_t> renumbered(list_.size(), 0);
  for (std::size_t n = 0; n < list_.size(); ++n) {
    if (used[n] == 0) continue;
    renumbered[n] = static_cast<std::uint16_t>(kept.size());
    kept.push_back(list_[n]);
  }
  for (std::uint16_t& number : material_of_cell) number = renumbered[number];
  return kept;
}

}  // namespace springlod::voxelize
