// Still pictures.

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "render/frames.hpp"
#include "render/overlay.hpp"
#include "render/scene.hpp"
#include "report/animate.hpp"
#include "report/film_cameras.hpp"
#include "scripting/bind/tables/draw_style.hpp"
#include "scripting/bind/tables/picture.hpp"
#include "scripting/bind/tables/still_pictures.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/quantity.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Pictures and reports";

/// Layout and camera of a still picture.
struct PictureOptions {
  std::uint32_t width = 640;  ///< of one panel [px]
  std::uint32_t height = 480;
  std::uint32_t columns = 0;  ///< 0: all panels in one row
  report::CameraMode camera = report::CameraMode::follow;
  double azimuth = -70;  ///< [deg]
  double elevation = 15;
  std::vector<std::string> titles;
  render::PictureText text;
};

std::vector<double> numbers_of(TableReader& reader, const char* name) {
  lua_State* L = reader.lua();
  const int table = reader.raw(name);
  if (table == 0) return {};
  if (!lua_istable(L, table)) reader.refuse(name, "a list of numbers, one per node");
  std::vector<double> numbers;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, table)); ++i) {
    lua_rawgeti(L, table, i);
    numbers.push_back(usual_quantity_at(L, -1, Dimension::number,
                                        fmt::format("{}: {}[{}]", reader.owner(), name, i)));
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  if (numbers.empty()) reader.refuse(name, "a list of numbers, one per node; it is empty");
  return numbers;
}

/// Options common to the picture and a single panel.
void read_panel_options(const Call& call, TableReader& reader, PanelOptions& options) {
  reader.read("frame", options.frame);
  reader.read("time", options.time);
  if (std::vector<double> values = numbers_of(reader, "node_values"); !values.empty()) {
    options.node_values = std::move(values);
    show_node_values(reader, options.style);
  }
  read_style(call, reader, options.style);
}

/// {subject, title = ..., time = ..., ...} at `table`: `usual` with what the keys change.
std::unique_ptr<Picture> read_panel(Call& call, int table, PanelOptions options,
                                    const std::string& owner) {
  lua_State* L = call.lua();
  if (lua_rawlen(L, table) != 1)
    throw InputError(fmt::format("{} must be {{subject, key = ...}} with one subject, got {}",
                                 owner, lua_rawlen(L, table)));
  lua_newtable(L);  // the keys alone
  const int keys = lua_gettop(L);
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    if (lua_type(L, -2) == LUA_TSTRING) {
      lua_pushvalue(L, -2);
      lua_insert(L, -2);
      lua_rawset(L, keys);
    } else {
      lua_pop(L, 1);
    }
  }
  TableReader reader = call.record(keys, "Panel", owner);
  reader.read("title", options.title);
  read_panel_options(call, reader, options);
  reader.finish();
  lua_settop(L, keys - 1);
  lua_rawgeti(L, table, 1);
  auto picture = Picture::of(L, lua_gettop(L), std::move(options));
  lua_pop(L, 1);
  return picture;
}

void refuse_keys(lua_State* L, int list) {
  lua_pushnil(L);
  while (lua_next(L, list) != 0) {
    lua_pop(L, 1);
    if (lua_type(L, -1) != LUA_TSTRING) continue;
    const std::string key = lua_tostring(L, -1);
    throw InputError(fmt::format(
        "render: a list of subjects has no key '{}'; a panel with keys is a table in the list, as "
        "in {{{{run, {} = ...}}}}",
        key, key));
  }
}

std::vector<std::unique_ptr<Picture>> read_panels(Call& call, const PictureOptions& picture,
                                                  const PanelOptions& usual) {
  lua_State* L = call.lua();
  const int index = call.index(2);
  const auto titled = [&](std::size_t panel) {
    PanelOptions options = usual;
    if (panel < picture.titles.size()) options.title = picture.titles[panel];
    return options;
  };
  std::vector<std::unique_ptr<Picture>> panels;
  if (!lua_istable(L, index)) {
    panels.push_back(Picture::of(L, index, titled(0)));
    return panels;
  }
  refuse_keys(L, index);
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, index)); ++i) {
    lua_rawgeti(L, index, i);
    const int entry = lua_gettop(L);
    panels.push_back(lua_istable(L, entry) ? read_panel(call, entry, titled(panels.size()),
                                                        fmt::format("render: panel {}", i))
                                           : Picture::of(L, entry, titled(panels.size())));
    lua_settop(L, entry - 1);
  }
  if (panels.empty()) call.refuse(2, "something to draw, or a list of such things");
  return panels;
}

Vec3 middle(const std::vector<Vec3>& points) {
  const Box3 box = bounds(points);
  return box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.center());
}

double size_of(const std::vector<Vec3>& points) {
  const Box3 box = bounds(points);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// The camera of each panel. A fixed camera sees every subject, wherever it is. Otherwise each
/// camera follows its subject; subjects of similar size have one scale, others each fill their
/// panel.
std::vector<render::Camera> cameras_of(const std::vector<std::unique_ptr<Picture>>& panels,
                                       const PictureOptions& options) {
  const bool follow = options.camera == report::CameraMode::follow;
  std::vector<std::vector<Vec3>> subjects;  // relative to their centers
  std::vector<Vec3> centers;
  std::vector<Vec3> all;
  std::vector<double> sizes;
  for (const auto& panel : panels) {
    std::vector<Vec3>& points = subjects.emplace_back(panel->points());
    centers.push_back(follow ? middle(points) : Vec3(Vec3::Zero()));
    for (Vec3& point : points) point -= centers.back();
    all.insert(all.end(), points.begin(), points.end());
    sizes.push_back(size_of(panel->body_at_rest()));
  }
  const int height = static_cast<int>(options.height);
  double headings = 0;
  double scales = 0;
  for (const auto& panel : panels) {
    headings = std::max(headings, panel->heading_share(height));
    scales = std::max(scales, panel->scales_share(height));
  }
  const render::LabelRoom room = render::room_beside_labels(headings, scales);
  const render::Framing framing{
      .azimuth = options.azimuth,
      .elevation = options.elevation,
      .aspect = static_cast<double>(options.width) / static_cast<double>(options.height),
      .headroom = room.above,
      .footroom = room.below};
  const bool own = follow && report::differ_in_size(sizes);
  const render::Camera common = render::frame_points(all, framing);
  std::vector<render::Camera> cameras;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    render::Camera& camera =
        cameras.emplace_back(own ? render::frame_points(subjects[i], framing) : common);
    camera.eye += centers[i];
    camera.target += centers[i];
  }
  return cameras;
}

int render_binding(Call& call) {
  PictureOptions options;
  PanelOptions usual;
  TableReader reader = call.options(3);
  reader.read("width", options.width);
  reader.read("height", options.height);
  reader.read("columns", options.columns);
  reader.read("camera", options.camera);
  reader.read("azimuth", options.azimuth);
  reader.read("elevation", options.elevation);
  reader.read("titles", options.titles);
  reader.read("title", options.text.title);
  reader.read("footer", options.text.footer);
  read_panel_options(call, reader, usual);
  reader.finish();

  const auto pictures = read_panels(call, options, usual);
  const std::vector<render::Camera> cameras = cameras_of(pictures, options);
  std::vector<render::Panel> panels;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    panels.push_back(pictures[i]->panel(cameras[i]));
  const render::PanelGrid grid{.panel_width = options.width,
                               .panel_height = options.height,
                               .panel_count = static_cast<std::uint32_t>(panels.size()),
                               .columns = options.columns};
  render::save_png(call.session().kept<StillPictures>().draw(grid, std::move(panels), options.text),
                   call.writable(1));
  return 0;
}

/// Options of a single panel or of all panels.
std::vector<Parameter> panel_parameters() {
  std::vector<Parameter> parameters{
      {.name = "frame",
       .type = "integer",
       .range = Range{1, 1e9},
       .fallback = "the last",
       .help = "frame of a trajectory, counted from 1"},
      {.name = "time",
       .type = "quantity",
       .dimension = Dimension::time,
       .range = Range{0, 1e9},
       .fallback = "none",
       .help = "time in a trajectory, instead of a frame"},
      {.name = "node_values",
       .type = "list of numbers",
       .fallback = "none",
       .help =
           "values, one for each node, shown by the colours of the nodes instead of node_colour"}};
  const std::vector<Parameter> style = style_parameters(render::DrawStyle{});
  parameters.insert(parameters.end(), style.begin(), style.end());
  return parameters;
}

std::vector<Parameter> render_parameters() {
  const PictureOptions usual;
  std::vector<Parameter> parameters{
      {.name = "width",
       .type = "integer",
       .range = Range{1, 16384},
       .fallback = fmt::format("{}", usual.width),
       .help = "width of a panel in pixels"},
      {.name = "height",
       .type = "integer",
       .range = Range{1, 16384},
       .fallback = fmt::format("{}", usual.height),
       .help = "height of a panel in pixels"},
      {.name = "columns",
       .type = "integer",
       .range = Range{1, 1000},
       .fallback = "all in one row",
       .help = "number of panels in a row"},
      {.name = "camera",
       .type = "one of",
       .fallback = "\"follow\"",
       .help = "whether the camera follows the body. All panels have one scale, but if it follows "
               "bodies that differ in size by more than a factor 1.5, each fills its panel",
       .choices = words_of<report::CameraMode>()},
      {.name = "azimuth",
       .type = "number",
       .range = Range{-360, 360},
       .fallback = fmt::format("{}", usual.azimuth),
       .help = "azimuth of the camera about the vertical, from x, in degrees"},
      {.name = "elevation",
       .type = "number",
       .range = Range{-90, 90},
       .fallback = fmt::format("{}", usual.elevation),
       .help = "elevation of the camera, in degrees"},
      {.name = "titles",
       .type = "list of strings",
       .range = Range{0, kLongestTitle},
       .fallback = "none",
       .help = "one title per panel; lines after the first are smaller"},
      {.name = "title",
       .type = "string",
       .range = Range{0, kLongestTitle},
       .fallback = "none",
       .help = "title above all panels; lines after the first are smaller"},
      {.name = "footer",
       .type = "string",
       .range = Range{0, kLongestTitle},
       .fallback = "none",
       .help = "line across the bottom"}};
  const std::vector<Parameter> of_panels = panel_parameters();
  parameters.insert(parameters.end(), of_panels.begin(), of_panels.end());
  return parameters;
}

void describe_panel(Api& api) {
  std::vector<Parameter> fields{{.name = "title",
                                 .type = "string",
                                 .range = Range{0, kLongestTitle},
                                 .fallback = "its entry in titles",
                                 .help = "title in the corner; lines after the first are smaller"}};
  for (Parameter parameter : panel_parameters()) {
    parameter.fallback = "the picture's";
    fields.push_back(std::move(parameter));
  }
  api.add(RecordEntry{.name = "Panel",
                      .summary = "A panel of s.render: {subject} with these additional keys, which "
                                 "override the options of the picture.",
                      .fields = std::move(fields),
                      .example = "{run, time = \"0.3 s\", title = \"at the wall\"}"});
}

}  // namespace

void describe_render(Api& api) {
  describe_panel(api);
  api.add(FunctionEntry{
      .name = "render",
      .group = kGroup,
      .summary = "Draws a still picture of a mesh, a model, a level or a frame of a run.",
      .arguments = {{.name = "path", .type = "string", .help = "NAME.png to write"},
                    {.name = "subject",
                     .type = "Mesh, Model, LodChain or Trajectory, or a list of them or of Panel",
                     .help = "subject to draw; a list gives panels, row by row"}},
      .options = render_parameters(),
      .returns = "nothing",
      .errors = "A size beyond the largest picture; node_values that are not one per node; a time "
                "outside the run; the file cannot be written.",
      .example = "s.render(\"out/levels.png\", {chain[0], chain[1], chain[2]},\n"
                 "  {springs = true, surface_opacity = 0.3, titles = {\"base\", \"level 1\", "
                 "\"level 2\"}})",
      .call = render_binding});
}

}  // namespace springlod::scripting
