#include "scripting/picture.hpp"

#include <utility>
#include <variant>

#include <fmt/format.h>
#include <lua.hpp>

#include "model/error.hpp"

namespace springlod {

namespace {

template <class T>
std::shared_ptr<const T> value_at(lua_State* L, int index) {
  return std::static_pointer_cast<const T>(boxed_at(L, index, &kValueName<T>));
}

const Frame& frame_of(const TrajectoryValue& value, std::uint32_t number) {
  const auto& frames = value.trajectory.frames;
  if (frames.empty() || number > frames.size())
    throw InputError(fmt::format("render: frame must be 1 to {}, got {}", frames.size(), number));
  return number == 0 ? frames.back() : frames[number - 1];
}

}  // namespace

std::vector<Colour> part_colours(const TriangleMesh& surface,
                                 const std::vector<Material>& materials) {
  std::vector<Colour> colours;
  bool found = false;
  for (std::size_t i = 0; i < surface.parts.size(); ++i) {
    colours.push_back(palette_colour(i));
    for (const Material& material : materials) {
      if (material.name != surface.parts[i].name && material.name != surface.parts[i].material)
        continue;
      colours.back() = material.colour;
      found = true;
    }
  }
  if (!found) colours.clear();
  return colours;
}

std::unique_ptr<Picture> Picture::of(lua_State* L, int index, const PictureOptions& options) {
  auto picture = std::make_unique<Picture>();
  if (auto mesh = value_at<MeshValue>(L, index)) {
    picture->mesh_ = mesh;
  } else if (auto model = value_at<ModelValue>(L, index)) {
    picture->set_model(model, nullptr);
  } else if (auto chain = value_at<LodAsset>(L, index)) {
    picture->set_model(level_value(chain, 0), nullptr);
  } else if (auto run = value_at<TrajectoryValue>(L, index)) {
    const Frame& frame = frame_of(*run, options.frame);
    picture->set_model(run->model, &frame.x);
    picture->add_obstacles(*run->scenario);
    picture->caption_ = fmt::format("t = {:.3f} s", frame.time);
  } else {
    throw InputError(fmt::format("render: expected a Mesh, Model, LodChain or Trajectory, got {}",
                                 describe_type_at(L, index)));
  }
  return picture;
}

void Picture::set_model(std::shared_ptr<const ModelValue> model,
                        const std::vector<Vec3>* positions) {
  model_ = std::move(model);
  positions_ = positions != nullptr ? *positions : model_->model->rest;
  if (model_->surface) surface_positions_ = carry(surface_binding(*model_), positions_);
}

void Picture::add_obstacles(const Scenario& scenario) {
  for (const Obstacle& obstacle : scenario.obstacles) {
    if (const auto* plane = std::get_if<Plane>(&obstacle.shape))
      planes_.push_back({plane->normal, plane->offset});
    if (const auto* box = std::get_if<SolidBox>(&obstacle.shape))
      boxes_.push_back({box->center, box->half_size, box->rotation});
  }
}

Box3 Picture::box() const {
  if (mesh_) return bounds(mesh_->mesh);
  Box3 box;
  for (const Vec3& point : positions_) box.extend(point);
  for (const Vec3& point : surface_positions_) box.extend(point);
  return box;
}

Panel Picture::panel(const PictureOptions& options, const Camera& camera,
                     const std::string& title) const {
  DrawnBody body;
  body.style = options.style;
  if (mesh_) {
    body.surface = &mesh_->mesh;
    body.style.surface = true;  // all that a mesh has
    body.style.nodes = false;
    body.style.springs = false;
  } else {
    body.model = model_->model.get();
    body.node_positions = &positions_;
    if (model_->surface) {
      body.surface = model_->surface.get();
      body.surface_positions = &surface_positions_;
      body.part_colours = part_colours(*model_->surface, model_->model->materials);
    } else {
      // Without a surface the model itself is all there is to see.
      body.style.nodes = true;
      body.style.springs = true;
    }
  }
  Panel panel;
  panel.bodies.push_back(std::move(body));
  panel.planes = planes_;
  panel.boxes = boxes_;
  panel.camera = camera;
  panel.title = title;
  if (!caption_.empty()) panel.captions.push_back(caption_);
  return panel;
}

void read_style(TableReader& reader, DrawStyle& style) {
  reader.read("surface", style.surface);
  reader.read("nodes", style.nodes);
  reader.read("springs", style.springs);
  reader.choose("spring_colour", style.spring_colour,
                {{"material", SpringColour::material}, {"strain", SpringColour::strain}});
  reader.read("strain_range", style.strain_range);
  reader.read("node_radius", style.node_radius);
  reader.read("surface_opacity", style.surface_opacity);
  reader.read("bold_inner_nodes", style.bold_inner_nodes);
}

std::vector<Parameter> style_parameters(const DrawStyle& usual) {
  const auto truth = [](bool value) { return std::string(value ? "true" : "false"); };
  return {{.name = "surface",
           .type = "boolean",
           .fallback = truth(usual.surface),
           .help = "draw the shaded surface, if there is one"},
          {.name = "nodes",
           .type = "boolean",
           .fallback = truth(usual.nodes),
           .help = "draw nodes as balls"},
          {.name = "springs",
           .type = "boolean",
           .fallback = truth(usual.springs),
           .help = "draw springs"},
          {.name = "spring_colour",
           .type = "one of",
           .fallback = "\"material\"",
           .help = "what the colour of a spring tells",
           .choices = {"material", "strain"}},
          {.name = "strain_range",
           .type = "number",
           .fallback = fmt::format("{}", usual.strain_range),
           .help = "strain drawn in full red (stretched) or blue (compressed)"},
          {.name = "node_radius",
           .type = "quantity",
           .dimension = Dimension::length,
           .fallback = "a part of the mean spring length",
           .help = "radius of the balls"},
          {.name = "surface_opacity",
           .type = "number",
           .fallback = fmt::format("{}", usual.surface_opacity),
           .help = "below 1 shows the springs inside"},
          {.name = "bold_inner_nodes",
           .type = "boolean",
           .fallback = truth(usual.bold_inner_nodes),
           .help = "nodes off the border in bold red"}};
}

}  // namespace springlod
