// Still pictures.

#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "model/error.hpp"
#include "render/frames.hpp"
#include "render/scene.hpp"
#include "scripting/call.hpp"
#include "scripting/picture.hpp"

namespace springlod {

namespace {

constexpr const char* kGroup = "Pictures and reports";

std::vector<std::unique_ptr<Picture>> subjects(Call& call, const PictureOptions& options) {
  lua_State* L = call.lua();
  const int index = call.index(2);
  std::vector<std::unique_ptr<Picture>> pictures;
  if (!lua_istable(L, index)) {
    pictures.push_back(Picture::of(L, index, options));
    return pictures;
  }
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, index)); ++i) {
    lua_rawgeti(L, index, i);
    pictures.push_back(Picture::of(L, lua_gettop(L), options));
    lua_pop(L, 1);
  }
  if (pictures.empty()) call.refuse(2, "something to draw, or a list of such things");
  return pictures;
}

int render_binding(Call& call) {
  PictureOptions options;
  TableReader reader = call.options(3);
  reader.read("width", options.width);
  reader.read("height", options.height);
  reader.read("azimuth", options.azimuth);
  reader.read("elevation", options.elevation);
  reader.read("frame", options.frame);
  reader.read("titles", options.titles);
  reader.read("footer", options.footer);
  read_style(reader, options.style);
  reader.finish();
  if (options.width == 0 || options.height == 0) reader.refuse("width", "1 or more, height too");

  const auto pictures = subjects(call, options);
  Box3 box;
  for (const auto& picture : pictures) box.extend(picture->box());
  const Camera camera =
      frame_box(box, options.azimuth, options.elevation,
                static_cast<double>(options.width) / static_cast<double>(options.height));
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    panels.push_back(
        pictures[i]->panel(options, camera, i < options.titles.size() ? options.titles[i] : ""));
  Renderer renderer(options.width, options.height, static_cast<std::uint32_t>(panels.size()));
  save_png(renderer.draw(panels, options.footer), call.path(1));
  return 0;
}

std::vector<Parameter> render_parameters() {
  const PictureOptions usual;
  std::vector<Parameter> parameters{
      {.name = "width",
       .type = "integer",
       .fallback = fmt::format("{}", usual.width),
       .help = "pixels of one panel"},
      {.name = "height",
       .type = "integer",
       .fallback = fmt::format("{}", usual.height),
       .help = "pixels of one panel"},
      {.name = "azimuth",
       .type = "number",
       .fallback = fmt::format("{}", usual.azimuth),
       .help = "where the camera stands, in degrees about the vertical from x"},
      {.name = "elevation",
       .type = "number",
       .fallback = fmt::format("{}", usual.elevation),
       .help = "how high it stands, in degrees"},
      {.name = "frame",
       .type = "integer",
       .fallback = "the last",
       .help = "frame of a trajectory, counted from 1"},
      {.name = "titles", .type = "list of strings", .fallback = "none", .help = "one a panel"},
      {.name = "footer", .type = "string", .fallback = "none", .help = "line across the bottom"}};
  const std::vector<Parameter> style = style_parameters(usual.style);
  parameters.insert(parameters.end(), style.begin(), style.end());
  return parameters;
}

}  // namespace

void describe_render(Api& api) {
  api.add(FunctionEntry{
      .name = "render",
      .group = kGroup,
      .summary = "Draws a still picture of a mesh, a model, a level or a frame of a run.",
      .arguments = {{.name = "path", .type = "string", .help = "NAME.png to write"},
                    {.name = "subject",
                     .type = "Mesh, Model, LodChain or Trajectory, or a list of them",
                     .help = "what to draw; a list gives panels side by side"}},
      .options = render_parameters(),
      .returns = "nothing",
      .errors = "A size beyond the largest picture; the file cannot be written.",
      .example = "s.render(\"out/levels.png\", {chain[0], chain[1], chain[2]},\n"
                 "  {springs = true, surface_opacity = 0.3, titles = {\"base\", \"LOD-1\", "
                 "\"LOD-2\"}})",
      .call = render_binding});
}

}  // namespace springlod
