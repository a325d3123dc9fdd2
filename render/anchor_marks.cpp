#include "render/anchor_marks.hpp"

#include <algorithm>
#include <cmath>

#include "render/camera.hpp"
#include "render/drawables.hpp"

namespace springlod::render {
namespace {

constexpr Colour kDot{0.10F, 0.11F, 0.14F};
constexpr Colour kRim{1, 1, 1};

// Fraction of the height of a panel, for panels up to this height / width; limits [px].
constexpr double kRadius = 0.0085;
constexpr double kNarrow = 1.15;
constexpr double kLeastRadius = 2.8;
constexpr double kLargestRadius = 12;
// Where nodes are dense, marks shrink to this fraction of the mean spring length, so that nodes
// can be told apart, but no further than this [px].
constexpr double kOfSpring = 0.28;
constexpr double kDenseRadius = 1.7;
// Width of the rim: fraction of the radius, at least 1 [px].
constexpr double kRimShare = 0.35;

double rim_of(double radius) {
  return std::max(1., kRimShare * radius);
}

void draw_disc(Image& image, const PixelRect& clip, double x, double y, double radius,
               const Colour& colour) {
  const int reach = static_cast<int>(std::ceil(radius + 1));
  const int left = std::max(static_cast<int>(x) - reach, clip.x);
  const int right = std::min(static_cast<int>(x) + reach, clip.x + clip.width - 1);
  const int top = std::max(static_cast<int>(y) - reach, clip.y);
  const int bottom = std::min(static_cast<int>(y) + reach, clip.y + clip.height - 1);
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const double away = std::hypot(column + 0.5 - x, row + 0.5 - y);
      const double cover = std::clamp(radius - away + 0.5, 0., 1.);
      if (cover > 0) blend_pixel(image, column, row, colour, cover);
    }
}

struct Mark {
  double x, y, radius;  // [px]
};

std::vector<Mark> marks_of(const DrawnBody& body, const Camera& camera, const PixelRect& place) {
  const MassSpringModel& model = *body.model;
  const std::vector<Vec3>& positions =
      body.node_positions != nullptr ? *body.node_positions : model.rest;
  const Mat4f projection = view_projection(camera, static_cast<double>(place.width) / place.height);
  double radius = anchor_mark_radius(place);
  if (model.spring_count() > 0) {
    const double spring = mean_spring_length(model) * place.height / (2 * view_radius(camera));
    radius = std::min(radius, std::max(kDenseRadius, kOfSpring * spring));
  }
  std::vector<Mark> marks;
  for (const std::uint32_t node : body.anchored) {
    if (is_cut_away(body, node)) continue;
    Eigen::Vector4f at;
    at << (positions[node] - camera.target).cast<float>(), 1;
    const Eigen::Vector4d clip = (projection * at).cast<double>();
    // Points behind the camera, or so far off that their pixels have no numbers.
    if (!(clip.w() > 0) || std::abs(clip.x()) > 2 * clip.w() || std::abs(clip.y()) > 2 * clip.w())
      continue;
    marks.push_back({place.x + (0.5 + clip.x() / clip.w() / 2) * place.width,
                     place.y + (0.5 - clip.y() / clip.w() / 2) * place.height, radius});
  }
  return marks;
}

}  // namespace

double anchor_mark_radius(const PixelRect& panel) {
  return std::clamp(kRadius * std::min<double>(panel.height, kNarrow * panel.width), kLeastRadius,
                    kLargestRadius);
}

void draw_anchor_mark(Image& image, const PixelRect& clip, double x, double y, double radius) {
  draw_disc(image, clip, x, y, radius + rim_of(radius), kRim);
  draw_disc(image, clip, x, y, radius, kDot);
}

bool marks_anchors(const Panel& panel) {
  return std::any_of(panel.bodies.begin(), panel.bodies.end(), [](const DrawnBody& body) {
    return body.style.anchors && !body.anchored.empty();
  });
}

void mark_anchors(Image& image, const PixelRect& place, const Panel& panel) {
  for (const DrawnBody& body : panel.bodies) {
    if (!body.style.anchors || body.anchored.empty()) continue;
    const std::vector<Mark> marks = marks_of(body, panel.camera, place);
    // First all rims: marks that touch have one rim around them.
    for (const Mark& mark : marks)
      draw_disc(image, place, mark.x, mark.y, mark.radius + rim_of(mark.radius), kRim);
    for (const Mark& mark : marks) draw_disc(image, place, mark.x, mark.y, mark.radius, kDot);
  }
}

}  // namespace springlod::render
