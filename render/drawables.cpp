#include "render/drawables.hpp"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "model/drawn_colour.hpp"
#include "render/cut.hpp"
#include "render/node_values.hpp"
#include "render/strain_colour.hpp"

namespace springlod::render {
namespace {

// Sizes as fractions of the mean spring length, small enough that balls do not touch and rods do
// not hide what is behind them.
constexpr double kNodeRadius = 0.11;
constexpr double kSpringRadius = 0.033;
// If balls show values, they are larger and springs are thin and grey, so that spring colours are
// not read as values.
constexpr double kValueNodeRadius = 0.20;
constexpr double kValueSpringFactor = 0.6;
constexpr Colour kValueSpringColour{0.66F, 0.68F, 0.71F};
// Figure 4 of the paper: inner nodes are emphasized, border nodes and springs are smaller.
constexpr double kBoldFactor = 1.6;
constexpr double kPlainFactor = 0.55;
constexpr double kStepBackFactor = 0.45;  // radius factor of springs
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
  return drawn_colour(model.materials, model.material[node]);
}

Colour mix(const Colour& a, const Colour& b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

/// Reference length for balls and rods: the mean spring length, or the node spacing without
/// springs.
double drawn_length(const MassSpringModel& model) {
  if (model.spring_count() > 0) return mean_spring_length(model);
  const Box3 box = bounds(model.rest);
  const double size = box.isEmpty() ? 0 : box.diagonal().norm();
  return size > 0 ? size / std::cbrt(static_cast<double>(model.node_count())) : 1;
}

}  // namespace

bool is_cut_away(const DrawnBody& body, std::uint32_t node) {
  const auto& cut = body.style.cut;
  return cut && cut->normal.dot(body.model->rest[node]) < cut->offset;
}

Colour part_colour(const DrawnBody& body, std::uint32_t part) {
  return part < body.part_colours.size() ? body.part_colours[part] : palette_colour(part);
}

std::vector<SurfaceVertex> surface_vertices(const DrawnBody& body, const SplitSurface& surface,
                                            const Vec3& origin) {
  const std::vector<Vec3>& positions = surface_positions(body);
  const std::vector<Eigen::Vector3f> normals = vertex_normals(surface, positions);
  const std::vector<float> inside = kept_distances(body);
  std::vector<SurfaceVertex> vertices(surface.source.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = {relative(positions[surface.source[i]], origin), normals[i],
                   part_colour(body, surface.part[i]), inside[surface.source[i]]};
  }
  return vertices;
}

std::vector<SpringInstance> spring_instances(const DrawnBody& body, const Vec3& origin) {
  const MassSpringModel& model = *body.model;
  const std::vector<Vec3>& x = node_positions(body);
  const bool strained = body.style.spring_colour == SpringColour::strain;
  const bool plain = !strained && (shows_values(body) || body.style.bold_inner_nodes);
  const double factor = !plain                        ? 1
                        : body.style.bold_inner_nodes ? kStepBackFactor
                                                      : kValueSpringFactor;
  const auto radius = static_cast<float>(factor * kSpringRadius * drawn_length(model));
  std::vector<SpringInstance> springs;
  springs.reserve(model.spring_count());
  for (std::size_t s = 0; s < model.spring_count(); ++s) {
    const std::uint32_t a = model.a[s];
    const std::uint32_t b = model.b[s];
    if (is_cut_away(body, a) || is_cut_away(body, b)) continue;
    SpringInstance spring{relative(x[a], origin), relative(x[b], origin), {}, {}, radius};
    if (strained) {
      const double strain = (x[b] - x[a]).norm() / model.rest_length[s] - 1;
      spring.colour_a = spring.colour_b = strain_colour(strain / body.style.strain_range);
    } else if (plain) {
      spring.colour_a = spring.colour_b = kValueSpringColour;
    } else {
      spring.colour_a = material_colour(model, a);
      spring.colour_b = material_colour(model, b);
    }
    springs.push_back(spring);
  }
  return springs;
}

std::vector<NodeInstance> node_instances(const DrawnBody& body, const Vec3& origin) {
  const MassSpringModel& model = *body.model;
  const std::vector<Vec3>& x = node_positions(body);
  const double usual = shows_values(body) ? kValueNodeRadius : kNodeRadius;
  const double radius =
      body.style.node_radius > 0 ? body.style.node_radius : usual * drawn_length(model);
  // If springs show strain, balls are neutral, so that their colours are not read as strain.
  const bool neutral = body.style.springs && body.style.spring_colour == SpringColour::strain;
  const double mean_mass =
      std::accumulate(model.mass.begin(), model.mass.end(), 0.) / model.node_count();
  std::vector<NodeInstance> nodes;
  nodes.reserve(model.node_count());
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if (is_cut_away(body, i)) continue;
    Colour colour = !body.node_colours.empty() ? body.node_colours[i]
                    : neutral                  ? kPlainColour
                                               : material_colour(model, i);
    double factor = 1;
    if (body.style.node_size == NodeSize::mass) factor = std::cbrt(model.mass[i] / mean_mass);
    if (body.style.bold_inner_nodes) {
      const bool inner = model.border[i] == 0;
      colour = inner ? kBoldColour : mix(kPlainColour, colour, 0.15F);
      factor *= inner ? kBoldFactor : kPlainFactor;
    }
    nodes.push_back({relative(x[i], origin), colour, static_cast<float>(radius * factor)});
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

std::vector<SpringInstance> box_edges(const DrawnBox& box, const Vec3& origin, const Colour& colour,
                                      float radius) {
  const TriangleMesh mesh = box_mesh(box);
  std::vector<SpringInstance> edges;
  for (unsigned corner = 0; corner < 8; ++corner)
    for (const unsigned axis : {1U, 2U, 4U})
      if ((corner & axis) == 0)
        edges.push_back({relative(mesh.positions[corner], origin),
                         relative(mesh.positions[corner | axis], origin), colour, colour, radius});
  return edges;
}

std::vector<Vec3> outline(const DrawnBody& body) {
  std::vector<Vec3> points;
  if (body.style.surface && body.surface != nullptr) points = surface_positions(body);
  const bool balls = draws_balls(body.style);
  if (body.model == nullptr || !(balls || body.style.springs)) return points;
  const Vec3 origin = node_positions(body).empty() ? Vec3(Vec3::Zero()) : node_positions(body)[0];
  for (const NodeInstance& node : node_instances(body, origin)) {
    const Vec3 center = origin + node.center.cast<double>();
    points.push_back(center);
    for (int axis = 0; balls && axis < 3; ++axis)
      for (const double side : {-1., 1.})
        points.emplace_back(center + side * static_cast<double>(node.radius) * Vec3::Unit(axis));
  }
  return points;
}

Box3 drawn_bounds(const DrawnBody& body) {
  Box3 box;
  if (body.style.surface && body.surface != nullptr) box.extend(bounds(surface_positions(body)));
  if (body.model != nullptr && (draws_balls(body.style) || body.style.springs))
    box.extend(bounds(node_positions(body)));
  return box;
}

void validate(const DrawnBody& body) {
  const auto require_finite = [](const std::vector<Vec3>& points, const char* what) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].allFinite())
        throw InputError(
            fmt::format("drawing: the position of {} {} is not finite", what, script_number(i)));
  };
  const DrawStyle& style = body.style;
  if (!(style.surface_opacity >= 0 && style.surface_opacity <= 1))
    throw InputError(
        fmt::format("drawing: surface_opacity = {} must be from 0 to 1", style.surface_opacity));
  if (!(style.strain_range > 0))
    throw InputError(fmt::format("drawing: strain_range = {} must be above 0", style.strain_range));
  if (style.node_radius < 0 || !std::isfinite(style.node_radius))
    throw InputError(fmt::format("drawing: node_radius = {} must be 0 or more", style.node_radius));
  if (style.cut && !(style.cut->normal.norm() > 0))
    throw InputError("drawing: the normal of a cut must not be zero");
  if (body.model != nullptr) {
    const std::vector<Vec3>& x = node_positions(body);
    if (x.size() != body.model->rest.size())
      throw InputError(fmt::format("drawing: {} positions for a model of {} nodes", x.size(),
                                   body.model->rest.size()));
    require_finite(x, "node");
    for (const std::uint32_t node : body.anchored)
      if (node >= x.size())
        throw InputError(fmt::format("drawing: anchored node {} for a model of {} nodes",
                                     script_number(node), x.size()));
    if (!body.node_colours.empty() && body.node_colours.size() != x.size())
      throw InputError(fmt::format("drawing: {} node colours for a model of {} nodes",
                                   body.node_colours.size(), x.size()));
  } else if (draws_balls(style) || style.springs) {
    throw InputError("drawing: the style shows nodes or springs, but the body has no model");
  }
  if (body.surface != nullptr) {
    const std::vector<Vec3>& x = surface_positions(body);
    if (x.size() != body.surface->positions.size())
      throw InputError(fmt::format("drawing: {} positions for a surface of {} vertices", x.size(),
                                   body.surface->positions.size()));
    require_finite(x, "surface vertex");
  }
}

}  // namespace springlod::render
