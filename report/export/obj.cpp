#include <cstdint>

#include <fmt/format.h>

#include "report/export/draft.hpp"

namespace springlod::report {

namespace {

void add_points(std::string& text, const std::vector<Vec3>& points) {
  for (const Vec3& p : points)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x(), p.y(), p.z());
}

// Faces of each mesh part as an object with its material.
void add_surface(std::string& text, const TriangleMesh& surface) {
  for (const MeshPart& part : surface.parts) {
    fmt::format_to(std::back_inserter(text), "o {}\n", part.name);
    if (!part.material.empty())
      fmt::format_to(std::back_inserter(text), "usemtl {}\n", part.material);
    for (std::uint32_t t = 0; t < part.triangle_count; ++t) {
      const Triangle& corner = surface.triangles[part.first_triangle + t];
      fmt::format_to(std::back_inserter(text), "f {} {} {}\n", corner[0] + 1, corner[1] + 1,
                     corner[2] + 1);
    }
  }
}

}  // namespace

ExportDraft draft_obj(const ExportedModel& body) {
  std::string text = fmt::format("# {}; metres, z up\n", body.origin);
  ExportDraft draft;
  if (body.surface) {
    add_points(text, surface_points(body));
    add_surface(text, *body.surface);
    draft.losses = {"nodes, springs, masses: OBJ holds the surface only"};
  } else {
    add_points(text, body.model.rest);
    text += "o springs\n";
    for (std::uint32_t s = 0; s < body.model.spring_count(); ++s)
      fmt::format_to(std::back_inserter(text), "l {} {}\n", body.model.a[s] + 1,
                     body.model.b[s] + 1);
    draft.losses = {"masses, stiffness, damping: OBJ holds points and lines only"};
  }
  draft.files = {{".obj", std::move(text)}};
  return draft;
}

}  // namespace springlod::report
