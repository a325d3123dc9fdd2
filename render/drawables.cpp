#include "render/drawables.hpp"

#include <cmath>

#include <fmt/format.h>

#include "model/error.hpp"
#include "render/strain_colour.hpp"

namespace springlod {
namespace {

// Sizes as a part of the mean spring length: balls stand clear of each other and rods show what is
// behind them.
constexpr double kNodeRadius = 0.11;
constexpr double kSpringRadius = 0.033;
// Of the paper's figure 4: inner nodes stand out, border nodes step back.
constexpr double kBoldFactor = 1.6;
constexpr double kPlainFactor = 0.55;
constexpr Colour kBoldColour{0.82F, 0.10F, 0.10F};
constexpr Colour kPlainColour{0.52F, 0.54F, 0.57F};

const std::vector<Vec3>& node_positions(const DrawnBody& body) {
  return body.node_positions != nullptr ? *body.node_positions : body.model->rest;
}
const std::vector<Vec3>& surface_positions(const DrawnBody& body) {
  return body.surface_positions != nullptr ? *body.surface_positions : body.surface->positions;
}

Eigen::Vector3f relative(const Vec3& p, const Vec3& origin) {
  return (p - origin).cast<float>();
}

Colour material_colour(const MassSpringModel& model, std::uint32_t node) {
  return drawn_colour(model, model.material[node]);
}

Colour mix(const Colour& a, const Colour& b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

}  // namespace

Colour drawn_colour(const MassSpringModel& model, std::uint32_t material) {
  const Colour& own = model.materials[material].colour;
  return own == Colour{} ? palette_colour(material) : own;
}

double mean_spring_length(const MassSpringModel& model) {
  if (model.spring_count() > 0) {
    double sum = 0;
    for (const double length : model.rest_length) sum += length;
    return sum / model.spring_count();
  }
  Box3 box;
  for (const Vec3& p : model.rest) box.extend(p);
  const double size = box.isEmpty() ? 0 : box.diagonal().norm();
  return size > 0 ? size / std::cbrt(static_cast<double>(model.node_count())) : 1;
}

std::vector<SurfaceVertex> surface_vertices(const DrawnBody& body, const SplitSurface& surface,
                                            const Vec3& origin) {
  const std::vector<Vec3>& positions = surface_positions(body);
  const std::vector<Eigen::Vector3f> normals = vertex_normals(surface, positions);
  std::vector<SurfaceVertex> vertices(surface.source.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t part = surface.part[i];
    const Colour colour =
        part < body.part_colours.size() ? body.part_colours[part] : palette_colour(part);
    vertices[i] = {relative(positions[surface.source[i]], origin), normals[i], colour};
  }
  return vertices;
}

std::vector<SpringInstance> spring_instances(const DrawnBody& body, const Vec3& origin) {
  const MassSpringModel& model = *body.model;
  const std::vector<Vec3>& x = node_positions(body);
  const auto radius = static_cast<float>(kSpringRadius * mean_spring_length(model));
  std::vector<SpringInstance> springs(model.spring_count());
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const std::uint32_t a = model.a[s];
    const std::uint32_t b = model.b[s];
    SpringInstance& spring = springs[s];
    spring = {relative(x[a], origin), relative(x[b], origin), {}, {}, radius};
    if (body.style.spring_colour == SpringColour::strain) {
      const double strain = (x[b] - x[a]).norm() / model.rest_length[s] - 1;
      spring.colour_a = spring.colour_b = strain_colour(strain / body.style.strain_range);
    } else {
      spring.colour_a = material_colour(model, a);
      spring.colour_b = material_colour(model, b);
    }
  }
  return springs;
}

std::vector<NodeInstance> node_instances(const DrawnBody& body, const Vec3& origin) {
  const MassSpringModel& model = *body.model;
  const std::vector<Vec3>& x = node_positions(body);
  const double radius =
      body.style.node_radius > 0 ? body.style.node_radius : kNodeRadius * mean_spring_length(model);
  // Strain takes the colours: then balls are neutral, else they would be read as strain.
  const bool neutral = body.style.springs && body.style.spring_colour == SpringColour::strain;
  std::vector<NodeInstance> nodes(model.node_count());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    Colour colour = neutral ? kPlainColour : material_colour(model, i);
    double factor = 1;
    if (body.style.bold_inner_nodes) {
      const bool inner = model.border[i] == 0;
      colour = inner ? kBoldColour : mix(kPlainColour, colour, 0.15F);
      factor = inner ? kBoldFactor : kPlainFactor;
    }
    nodes[i] = {relative(x[i], origin), colour, static_cast<float>(radius * factor)};
  }
  return nodes;
}

TriangleMesh box_mesh(const DrawnBox& box) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 local((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                     (corner & 4) != 0 ? 1 : -1);
    mesh.positions.emplace_back(box.center + box.rotation * local.cwiseProduct(box.half_size));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.parts = {{"box", "", 0, 12}};
  return mesh;
}

Box3 drawn_bounds(const DrawnBody& body) {
  Box3 box;
  if (body.style.surface && body.surface != nullptr)
    for (const Vec3& p : surface_positions(body)) box.extend(p);
  if (body.model != nullptr && (body.style.nodes || body.style.springs))
    for (const Vec3& p : node_positions(body)) box.extend(p);
  return box;
}

void validate(const DrawnBody& body) {
  const auto require_finite = [](const std::vector<Vec3>& points, const char* what) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].allFinite())
        throw InputError(fmt::format("drawing: {} {} is not at a finite place", what, i));
  };
  const DrawStyle& style = body.style;
  if (!(style.surface_opacity >= 0 && style.surface_opacity <= 1))
    throw InputError(
        fmt::format("drawing: surface_opacity = {} must be from 0 to 1", style.surface_opacity));
  if (!(style.strain_range > 0))
    throw InputError(fmt::format("drawing: strain_range = {} must be above 0", style.strain_range));
  if (style.node_radius < 0 || !std::isfinite(style.node_radius))
    throw InputError(fmt::format("drawing: node_radius = {} must be 0 or more", style.node_radius));
  if (body.model != nullptr) {
    const std::vector<Vec3>& x = node_positions(body);
    if (x.size() != body.model->rest.size())
      throw InputError(fmt::format("drawing: {} positions for a model of {} nodes", x.size(),
                                   body.model->rest.size()));
    require_finite(x, "node");
  } else if (style.nodes || style.springs || style.bold_inner_nodes) {
    throw InputError("drawing: nodes or springs are asked for, but the body has no model");
  }
  if (body.surface != nullptr) {
    const std::vector<Vec3>& x = surface_positions(body);
    if (x.size() != body.surface->positions.size())
      throw InputError(fmt::format("drawing: {} positions for a surface of {} vertices", x.size(),
                                   body.surface->positions.size()));
    require_finite(x, "surface vertex");
  }
}

}  // namespace springlod
