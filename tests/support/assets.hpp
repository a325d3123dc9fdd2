#pragma once

#include <cmath>

#include "model/chain.hpp"
#include "tests/support/lattices.hpp"

namespace springlod::test {

/// Closed box from the origin to `size`, in two parts.
inline TriangleMesh box_mesh(const Vec3& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back((i & 1) * size.x(), (i >> 1 & 1) * size.y(), (i >> 2) * size.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.parts = {{"lid and floor", "steel", 0, 4}, {"sides", "", 4, 8}};
  return mesh;
}

/// Three levels whose values need all digits, a surface and its binding.
inline LodAsset sample_asset() {
  LodAsset asset;
  for (const int n : {4, 3, 2}) {
    Level level;
    level.model = box_lattice(n, n, n + 1, 0.1 / 3);
    level.made_by = n == 4 ? "" : "by hand, \"quoted\", \xC3\xBC";
    MassSpringModel& m = level.model;
    m.materials = {{"steel", 2.1e11 / 3, 7850.1, 1e-7, {0.1F, 0.2F, 0.3F}},
                   {"rubber", 1e5 / 7, 1100, 0, {0.9F, 0.8F, 0.7F}}};
    for (std::uint32_t i = 0; i < m.node_count(); ++i) {
      m.mass[i] = 1e-3 / (i + 3);
      m.volume[i] = 1e-6 / (i + 7);
      m.contact_area[i] = i % 3 == 0 ? 0 : 1e-4 / i;
      m.border[i] = i % 2;
      m.material[i] = i % 2;
    }
    for (std::uint32_t s = 0; s < m.spring_count(); ++s) {
      m.stiffness[s] = 1e5 / (s + 11);
      m.damping[s] = s % 5 == 0 ? 0 : 1.0 / s;
    }
    const std::uint32_t base =
        asset.chain.levels.empty() ? m.node_count() : asset.chain.levels[0].model.node_count();
    level.of_base = identity_groups(m.node_count());
    for (std::uint32_t i = m.node_count(); i < base; ++i)
      level.of_base.of.push_back(i % m.node_count());
    asset.chain.levels.push_back(level);
  }
  asset.surface = box_mesh({0.1, 0.1, 0.4 / 3});
  asset.surface_of_base = bind_points(asset.surface.positions, asset.chain.levels[0].model);
  asset.provenance.set("made by", "a test");
  asset.provenance.set("a first key", "");
  return asset;
}

/// A certificate with all fields set, whose values need all digits.
inline Certificate sample_certificate() {
  Certificate c;
  c.moduli = {{"steel", 2e11 / 3, 2.1e11 / 3, 0.7 / 3, 0.25}, {"rubber", 1e5 / 7, 1e5, 0.1, 0.2}};
  c.frequencies = {{10.0 / 3, 3.3, 1.0 / 1.01, 1.0 / 7, 0.15}, {0.1 / 0.3, 0.35, 0.2, 0.3, 0.2}};
  c.loads = {{"stretch x", false, 1e-7 / 3, -0.02 / 3}, {"pinch \"1\"", true, 2, 0.1}};
  c.mass_error = 1e-17;
  c.center_shift = 2e-3 / 7;
  c.second_moment_error = 1.0 / 81;
  c.highest_frequency = 1e4 / 3;
  c.base_highest_frequency = 2e4;
  c.stable_step = 1e-3 / 7;
  c.base_stable_step = 1e-4;
  c.cost = 1e9 / 11;
  c.base_cost = 1e10;
  c.zero_modes = 7;
  c.expected_zero_modes = 6;
  c.blow_error = 0.01 / 3;
  c.first_period_error = 0.7 / 3;
  c.contact_ratio = 4.0 / 3;
  c.tolerance = 0.05;
  c.unmet = {"7 zero modes instead of 6", "f1..10: error 4.9 %, tolerance 3 %: \xC3\xBC"};
  return c;
}

}  // namespace springlod::test
