#include "scripting/bind/tables/picture.hpp"

#include <algorithm>
#include <sstream>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "model/drawn_colour.hpp"
#include "render/drawables.hpp"
#include "render/node_values.hpp"
#include "render/overlay.hpp"
#include "report/playback.hpp"

namespace springlod::scripting {

namespace {

template <class T>
std::shared_ptr<const T> value_at(lua_State* L, int index) {
  return std::static_pointer_cast<const T>(boxed_at(L, index, &kValueName<T>));
}

const sim::Frame& frame_of(const sim::Trajectory& trajectory, std::uint32_t number) {
  const auto& frames = trajectory.frames;
  if (frames.empty() || number > frames.size())
    throw InputError(fmt::format("render: frame must be 1 to {}, got {}", frames.size(), number));
  return number == 0 ? frames.back() : frames[number - 1];
}

void require_instant(const sim::Trajectory& trajectory, double time) {
  const auto& frames = trajectory.frames;
  // A run ends on a whole step, so a small excess of the time is accepted.
  constexpr double kSlack = 1e-3;
  if (frames.empty() || time < frames.front().time || time > frames.back().time + kSlack)
    throw InputError(fmt::format(
        "render: time must be within the run, 0 to {:.4g} s, got {:g} s; run it longer or ask for "
        "an earlier instant",
        frames.empty() ? 0 : frames.back().time, time));
}

void require_one_value_a_node(const PanelOptions& options, const ModelValue* model) {
  if (options.node_values.empty()) return;
  if (model == nullptr)
    throw InputError("render: node_values need nodes, but a Mesh has none; draw a model");
  if (options.node_values.size() != model->model->node_count())
    throw InputError(
        fmt::format("render: node_values must be one number per node: {} numbers for a "
                    "model of {} nodes",
                    options.node_values.size(), model->model->node_count()));
  if (options.style.node_colour != render::NodeColour::material)
    throw InputError(
        "render: node_values and node_colour both set the colours of the nodes; give "
        "one of them");
}

// Parts of one material have one colour, although its values are not known yet.
std::vector<Colour> material_colours(const TriangleMesh& mesh) {
  std::vector<std::string> names;
  std::vector<Colour> colours;
  for (const MeshPart& part : mesh.parts) {
    const std::string& name = part.material.empty() ? part.name : part.material;
    const auto at = std::find(names.begin(), names.end(), name);
    colours.push_back(palette_colour(static_cast<std::size_t>(at - names.begin())));
    if (at == names.end()) names.push_back(name);
  }
  return colours;
}

}  // namespace

std::vector<Colour> part_colours(const TriangleMesh& surface,
                                 const std::vector<Material>& materials) {
  std::vector<Colour> colours;
  bool found = false;
  for (std::size_t i = 0; i < surface.parts.size(); ++i) {
    colours.push_back(palette_colour(i));
    for (std::uint32_t m = 0; m < materials.size(); ++m) {
      const std::string& name = materials[m].name;
      if (name != surface.parts[i].name && name != surface.parts[i].material) continue;
      colours.back() = drawn_colour(materials, m);
      found = true;
    }
  }
  if (!found) colours.clear();
  return colours;
}

std::unique_ptr<Picture> Picture::of(lua_State* L, int index, PanelOptions options) {
  auto picture = std::make_unique<Picture>();
  picture->options_ = std::move(options);
  if (auto mesh = value_at<MeshValue>(L, index)) {
    picture->mesh_ = mesh;
  } else if (auto model = value_at<ModelValue>(L, index)) {
    picture->set_model(model, nullptr);
  } else if (auto chain = value_at<ChainValue>(L, index)) {
    picture->set_model(level_value(chain, 0), nullptr);
  } else if (auto run = value_at<TrajectoryValue>(L, index)) {
    picture->set_instant(*run);
  } else {
    throw InputError(fmt::format("render: expected a Mesh, Model, LodChain or Trajectory, got {}",
                                 describe_type_at(L, index)));
  }
  require_one_value_a_node(picture->options_, picture->model_.get());
  return picture;
}

void Picture::set_instant(const TrajectoryValue& run) {
  const PanelOptions& options = options_;
  if (options.time && options.frame != 0)
    throw InputError("render: frame and time both choose the instant; give one of them");
  double time = 0;
  if (options.time) {
    require_instant(run.trajectory, *options.time);
    time = *options.time;
    const std::vector<Vec3> positions = report::positions_at(run.trajectory.frames, time);
    set_model(run.model, &positions);
  } else {
    const sim::Frame& frame = frame_of(run.trajectory, options.frame);
    time = frame.time;
    set_model(run.model, &frame.x);
  }
  anchored_ = run.trajectory.anchored;
  add_obstacles(*run.scenario);
  instant_ = fmt::format("t = {:.3f} s", time);
}

void Picture::set_model(std::shared_ptr<const ModelValue> model,
                        const std::vector<Vec3>* positions) {
  model_ = std::move(model);
  positions_ = positions != nullptr ? *positions : model_->model->rest;
  if (model_->surface) surface_positions_ = interpolate(surface_binding(*model_), positions_);
}

void Picture::add_obstacles(const sim::Scenario& scenario) {
  for (const sim::Obstacle& obstacle : scenario.obstacles) {
    if (const auto* plane = std::get_if<sim::Plane>(&obstacle.shape))
      planes_.push_back({plane->normal, plane->offset});
    if (const auto* box = std::get_if<sim::SolidBox>(&obstacle.shape))
      boxes_.push_back({box->center, box->half_size, box->rotation});
  }
}

std::vector<Vec3> Picture::points() const {
  return render::outline(panel(render::Camera{}).bodies.front());
}

std::vector<Vec3> Picture::body_at_rest() const {
  if (mesh_) return mesh_->mesh.positions;
  if (model_->surface) return model_->surface->positions;
  return model_->model->rest;
}

std::vector<std::string> Picture::heading() const {
  std::vector<std::string> lines;
  std::istringstream title(options_.title);
  for (std::string line; std::getline(title, line);) lines.push_back(line);
  if (!instant_.empty()) lines.push_back(instant_);
  return lines;
}

double Picture::heading_share(int panel_height) const {
  const std::size_t lines = heading().size();
  return lines == 0 ? 0 : render::heading_share(panel_height, lines - 1);
}

double Picture::scales_share(int panel_height) const {
  const render::DrawnBody body = panel(render::Camera{}).bodies.front();
  const bool strain =
      body.style.springs && body.style.spring_colour == render::SpringColour::strain;
  return ((render::shows_values(body) ? 1 : 0) + (strain ? 1 : 0)) *
         render::scale_share(panel_height);
}

render::Panel Picture::panel(const render::Camera& camera) const {
  render::DrawnBody body;
  body.style = options_.style;
  if (mesh_) {
    body.surface = &mesh_->mesh;
    body.part_colours = material_colours(mesh_->mesh);
    body.style.surface = true;  // a mesh has only its surface
    body.style.nodes = false;
    body.style.springs = false;
    body.style.bold_inner_nodes = false;
  } else {
    body.model = model_->model.get();
    body.node_positions = &positions_;
    body.anchored = anchored_;
    if (!options_.node_values.empty()) body.node_values = &options_.node_values;
    if (model_->surface) {
      body.surface = model_->surface.get();
      body.surface_positions = &surface_positions_;
      body.part_colours = part_colours(*model_->surface, model_->model->materials);
    } else {
      // Without a surface, the model itself is drawn.
      body.style.nodes = true;
      body.style.springs = true;
    }
  }
  render::Panel panel;
  panel.bodies.push_back(std::move(body));
  panel.planes = planes_;
  panel.boxes = boxes_;
  panel.camera = camera;
  const std::vector<std::string> lines = heading();
  if (!lines.empty()) {
    panel.title = lines.front();
    panel.captions.assign(lines.begin() + 1, lines.end());
  }
  return panel;
}

}  // namespace springlod::scripting
