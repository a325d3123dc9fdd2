#include "voxelize/cells/claim_order.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::voxelize {
namespace {

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return text;
}

}  // namespace

std::vector<std::size_t> claim_order(const TriangleMesh& mesh,
                                     const std::vector<SolidReport>& solids,
                                     const std::vector<std::string>& priority) {
  std::vector<std::size_t> order;
  const auto take = [&](std::size_t s) {
    if (std::find(order.begin(), order.end(), s) == order.end()) order.push_back(s);
  };
  for (const std::string& name : priority) {
    bool found = false;
    for (std::size_t s = 0; s < solids.size(); ++s)
      for (const std::uint32_t p : solids[s].parts)
        if (mesh.parts[p].name == name) {
          take(s);
          found = true;
        }
    if (found) continue;
    std::vector<std::string> names;
    names.reserve(solids.size());
    for (const SolidReport& solid : solids) names.push_back(solid.part);
    throw InputError(fmt::format("voxelize: priority has the unknown part \"{}\"; the parts are {}",
                                 name, quoted(names)));
  }
  for (std::size_t s = 0; s < solids.size(); ++s) take(s);
  return order;
}

}  // namespace springlod::voxelize
