#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/script_number.hpp"
#include "elastic/loads.hpp"
#include "model/material_pieces.hpp"

namespace springlod::elastic {
namespace {

using Nodes = std::vector<std::uint32_t>;

bool reaches_surface(const MassSpringModel& model, const Nodes& piece) {
  return std::any_of(piece.begin(), piece.end(),
                     [&](std::uint32_t i) { return model.border[i] != 0; });
}

}  // namespace

std::vector<StaticLoad> piece_loads(const MassSpringModel& model, const PieceOptions& options) {
  std::vector<Nodes> pieces = material_pieces(model);
  if (pieces.size() == 1) return {};
  std::erase_if(pieces, [&](const Nodes& piece) {
    return piece.size() < options.least_nodes || !reaches_surface(model, piece);
  });
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Nodes& p, const Nodes& q) { return p.size() > q.size(); });
  pieces.resize(std::min(pieces.size(), options.most_pieces));

  std::vector<StaticLoad> loads;
  for (const Nodes& piece : pieces) {
    MassSpringModel alone = model;  // smooth loads act on volume
    alone.volume.assign(model.node_count(), 0);
    for (const std::uint32_t i : piece) alone.volume[i] = model.volume[i];
    const std::uint32_t first = piece.front();
    for (StaticLoad& load : smooth_loads(alone)) {
      load.name += fmt::format(" of {} at node {}", model.materials[model.material[first]].name,
                               script_number(first));
      loads.push_back(std::move(load));
    }
  }
  return loads;
}

}  // namespace springlod::elastic
