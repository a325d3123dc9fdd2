#pragma once

#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/asset/gltf_builder.hpp"
#include "model/creases.hpp"
#include "model/material.hpp"
#include "model/mesh.hpp"

namespace springlod::inline model {

// Surfaces as glTF draws them: a primitive for each mesh part, of vertices split at creases.

/// Positions of the drawn vertices, of those of the mesh vertices [m].
std::vector<Vec3> drawn_positions(const SplitSurface& surface, const std::vector<Vec3>& positions);
/// Their normals: of unit length, as glTF needs them, also where all triangles are degenerate; +z
/// is used there.
std::vector<Vec3> drawn_normals(const SplitSurface& surface, const std::vector<Vec3>& positions);

/// Triangles as a view of the buffer, three indices each.
struct IndexView {
  std::size_t view;
  gltf::Component component;
};
IndexView add_triangles(GltfBuilder& gltf, const std::vector<Triangle>& triangles);

/// A primitive of these attributes for each part that has triangles. A part has the colour of the
/// material of `materials` that has its name (part_colour).
nlohmann::json part_primitives(GltfBuilder& gltf, const std::vector<MeshPart>& parts,
                               const std::vector<Material>& materials,
                               const nlohmann::json& attributes, const IndexView& triangles);

}  // namespace springlod::inline model
