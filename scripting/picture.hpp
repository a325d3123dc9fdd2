#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/scene.hpp"
#include "scripting/call.hpp"
#include "scripting/values.hpp"

namespace springlod {

/// How a still picture is taken: the options of `s.render`.
struct PictureOptions {
  std::uint32_t width = 640;  ///< of one panel [px]
  std::uint32_t height = 480;
  double azimuth = -70;  ///< [deg]
  double elevation = 15;
  std::uint32_t frame = 0;  ///< of trajectories, counted from 1; 0: the last
  std::vector<std::string> titles;
  std::string footer;
  DrawStyle style;
};

/// One subject of a picture with all that a Panel points into.
class Picture {
 public:
  /// The Mesh, Model, LodChain (its base) or Trajectory at `index`. Throws InputError for others.
  static std::unique_ptr<Picture> of(lua_State* L, int index, const PictureOptions& options);

  /// What the camera has to see.
  Box3 box() const;
  /// Good as long as this lives.
  Panel panel(const PictureOptions& options, const Camera& camera, const std::string& title) const;

 private:
  void set_model(std::shared_ptr<const ModelValue> model, const std::vector<Vec3>* positions);
  void add_obstacles(const Scenario& scenario);

  std::shared_ptr<const MeshValue> mesh_;
  std::shared_ptr<const ModelValue> model_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> surface_positions_;
  std::vector<DrawnPlane> planes_;
  std::vector<DrawnBox> boxes_;
  std::string caption_;
};

/// Reads the options of a DrawStyle (surface, nodes, springs, ...), listed by style_parameters().
void read_style(TableReader& reader, DrawStyle& style);
std::vector<Parameter> style_parameters(const DrawStyle& usual);

/// Colour of each surface part: of the material with the part's name or its material's name; empty
/// if none is found.
std::vector<Colour> part_colours(const TriangleMesh& surface,
                                 const std::vector<Material>& materials);

}  // namespace springlod
