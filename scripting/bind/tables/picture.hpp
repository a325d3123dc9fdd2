#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/scene.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// Options of one panel of a picture.
struct PanelOptions {
  /// In the corner; lines after the first are smaller.
  std::string title;
  std::uint32_t frame = 0;     ///< of a trajectory, counted from 1; 0: the last
  std::optional<double> time;  ///< of a trajectory [s]: this instant instead of a frame
  /// Values shown as colours of the nodes, one for each node; empty: none.
  std::vector<double> node_values;
  render::DrawStyle style;
};

/// One subject of a picture; owns all data that a Panel points to.
class Picture {
 public:
  /// The Mesh, Model, LodChain (its base) or Trajectory at `index`. Throws InputError for other
  /// types and for options that do not apply.
  static std::unique_ptr<Picture> of(lua_State* L, int index, PanelOptions options);

  /// Fraction of a panel's height used by its title and captions; 0 if there are none.
  double heading_share(int panel_height) const;
  /// Fraction used by its colour bars.
  double scales_share(int panel_height) const;
  /// Points that the camera must show [m].
  std::vector<Vec3> points() const;
  /// The points of the whole body at rest [m]; a level has those of its base's surface, if any.
  std::vector<Vec3> body_at_rest() const;
  /// Valid for the lifetime of this object.
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
  std::vector<std::uint32_t> anchored_;  // nodes
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
