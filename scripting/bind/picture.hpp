#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/scene.hpp"
#include "scripting/bind/values.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// What one panel of a picture shows of its subject.
struct PanelOptions {
  /// In the corner; lines after the first are smaller.
  std::string title;
  std::uint32_t frame = 0;     ///< of a trajectory, counted from 1; 0: the last
  std::optional<double> time;  ///< of a trajectory [s]: this instant instead of a frame
  /// Numbers that the nodes show, one a node; empty: none.
  std::vector<double> node_values;
  render::DrawStyle style;
};

/// One subject of a picture with all that a Panel points into.
class Picture {
 public:
  /// The Mesh, Model, LodChain (its base) or Trajectory at `index`. Throws InputError for others
  /// and for options that do not fit it.
  static std::unique_ptr<Picture> of(lua_State* L, int index, PanelOptions options);

  /// Part of a panel's height that its title and captions take; 0 without any.
  double heading_share(int panel_height) const;
  /// Part that its colour scales take.
  double scales_share(int panel_height) const;
  /// All that the camera has to see.
  std::vector<Vec3> points() const;
  /// Good as long as this lives.
  render::Panel panel(const render::Camera& camera) const;

 private:
  void set_model(std::shared_ptr<const ModelValue> model, const std::vector<Vec3>* positions);
  std::vector<std::string> heading() const;
  void set_instant(const TrajectoryValue& run);
  void add_obstacles(const sim::Scenario& scenario);

  PanelOptions options_;
  std::shared_ptr<const MeshValue> mesh_;
  std::shared_ptr<const ModelValue> model_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> surface_positions_;
  std::vector<render::DrawnPlane> planes_;
  std::vector<render::DrawnBox> boxes_;
  std::string instant_;  // "t = 0.300 s" of a trajectory
};

/// Colour of each surface part: of the material with the part's name or its material's name; empty
/// if none is found.
std::vector<Colour> part_colours(const TriangleMesh& surface,
                                 const std::vector<Material>& materials);

}  // namespace springlod::scripting
