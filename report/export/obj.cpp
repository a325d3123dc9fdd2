#include <cstdint>
#include <iterator>

#include <fmt/format.h>

#include "report/export/draft.hpp"
#include "report/export/obj_text.hpp"

namespace springlod::report {

namespace {

std::string with_points(const std::string& origin, const std::vector<Vec3>& points) {
  std::string text = fmt::format("# {}; metres, z up\n", origin);
  for (const Vec3& p : points)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x(), p.y(), p.z());
  return text;
}

}  // namespace

std::string obj_text(const ExportedModel& body, const std::vector<Vec3>& points) {
  std::string text = with_points(body.origin, points) + fmt::format("o {}\n", body.name);
  for (const MeshPart& part : body.surface->parts) {
    fmt::format_to(std::back_inserter(text), "g {}\n", part.name);
    if (!part.material.empty())
      fmt::format_to(std::back_inserter(text), "usemtl {}\n", part.material);
    for (std::uint32_t t = 0; t < part.triangle_count; ++t) {
      const Triangle& corner = body.surface->triangles[part.first_triangle + t];
      fmt::format_to(std::back_inserter(text), "f {} {} {}\n", corner[0] + 1, corner[1] + 1,
                     corner[2] + 1);
    }
  }
  return text;
}

ExportDraft draft_obj(const ExportedModel& body) {
  if (body.surface)
    return {.files = {{".obj", obj_text(body, surface_points(body))}},
            .settings = {},
            .losses = {"nodes, springs, masses: OBJ holds the surface only"}};
  std::string text = with_points(body.origin, body.model.rest) + "o springs\n";
  for (std::uint32_t s = 0; s < body.model.spring_count(); ++s)
    fmt::format_to(std::back_inserter(text), "l {} {}\n", body.model.a[s] + 1, body.model.b[s] + 1);
  return {.files = {{".obj", std::move(text)}},
          .settings = {},
          .losses = {"masses, stiffness, damping: OBJ holds points and lines only"}};
}

}  // namespace springlod::report
