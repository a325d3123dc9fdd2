#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "model/node_dilatation.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/models.hpp"

namespace springlod::test {

/// A box_lattice of nx x ny x nz nodes at distance 1 with a term of modulus 2 J and damping time
/// 0.1 s for each cell.
inline MassSpringModel lattice_with_terms(int nx, int ny, int nz) {
  MassSpringModel model = box_lattice(nx, ny, nz);
  std::vector<std::uint32_t> nodes(8);
  std::vector<Vec3> gradients(8);
  for (int z = 0; z + 1 < nz; ++z)
    for (int y = 0; y + 1 < ny; ++y)
      for (int x = 0; x + 1 < nx; ++x) {
        for (unsigned c = 0; c < 8; ++c) {
          const int right = c & 1U, back = c >> 1U & 1U, up = c >> 2U;
          nodes[c] = static_cast<std::uint32_t>(((z + up) * ny + y + back) * nx + x + right);
          gradients[c] = Vec3(2 * right - 1, 2 * back - 1, 2 * up - 1) / 4;
        }
        model.dilatation.add(2, 0.1, nodes, gradients);
      }
  validate(model);
  return model;
}

/// A random_model whose nodes have dilatation terms, some of them below 0 if `mixed`.
inline MassSpringModel random_model_with_terms(std::uint64_t seed, int n = 4, bool mixed = true) {
  MassSpringModel model = random_model(seed, n);
  std::mt19937_64 random(seed + 1);
  std::vector<NodeDilatation> of_nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    of_nodes.push_back(
        {(mixed && uniform(random) < 0.2 ? -20 : 200) * uniform(random), 0.002 * uniform(random)});
  model.dilatation = node_terms(model, of_nodes);
  validate(model);
  return model;
}

inline std::vector<Vec3> random_vectors(std::uint64_t seed, std::size_t count, double size) {
  std::mt19937_64 random(seed);
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    all.emplace_back(size * (2 * x - 1), size * (2 * y - 1), size * (2 * z - 1));
  }
  return all;
}

}  // namespace springlod::test
