#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/fast/fast_body.hpp"
#include "sim/fast/passage.hpp"

namespace springlod::sim {

/// What a body touches with points that several of its nodes carry, maybe of several blocks: one
/// for the whole body, worked by one thread while the others wait. An obstacle costs nothing while
/// the body is clear of it, and next to nothing a point that cannot have come to it yet.
class SkinContacts {
 public:
  /// One step of the body.
  struct Step {
    std::uint64_t number = 0;
    MovingFrame frame;   ///< at the places of this step
    MovingFrame kicked;  ///< after the kick
    double kick = 0;     ///< [s]; 0: none
    double length = 0;   ///< dt [s]
  };

  /// All must outlive this.
  SkinContacts(const MassSpringModel& model, const ContactPoints& points,
               const std::vector<Obstacle>& obstacles, FastBody& body, ContactFinder& finder,
               TunnelWatch& walls);

  /// Whether points went through walls on the way here; then, if there is a kick, finds the
  /// contacts and adds their normal forces and friction to those that the body has collected.
  void act(const Step& step);

  const std::vector<Contact>& now() const { return contacts_; }
  /// Of the points of now(), before the kick and after it [m/s].
  const std::vector<Vec3>& velocities_before() const { return before_; }
  const std::vector<Vec3>& velocities_after() const { return after_; }
  /// Number of the first step with a contact.
  const std::optional<std::uint64_t>& first_step() const { return first_step_; }
  /// The first point that went through a wall.
  const std::optional<Passage>& passage() const { return passage_; }

 private:
  /// What was seen of one obstacle.
  struct View {
    std::optional<std::uint64_t> last;  // step at which it was looked at
    std::vector<double> due;            // travel before which a point cannot touch it [m]
  };

  /// Bounds of all points in world axes [m].
  Box3 bounds(const MovingFrame& frame) const;
  bool near_anything(const Box3& region) const;
  void arrive(const Step& step, bool near, const Box3& swept);
  void watch(const Step& step, const Box3& swept);
  void press(const Step& step, std::size_t obstacle);
  void rub(const Step& step);
  Vec3 kicked_velocity(const Contact& contact, const Step& step) const;

  const MassSpringModel* model_;
  const ContactPoints* points_;
  const std::vector<Obstacle>* obstacles_;
  FastBody* body_;
  ContactFinder* finder_;
  TunnelWatch* walls_;
  double reach_ = 1;         // the largest of the points [1]
  std::vector<Vec3> x_, v_;  // of the nodes
  Box3 bounds_;
  std::optional<std::uint64_t> arrived_;   // at which step
  double travel_ = 0, travel_before_ = 0;  // of the fastest node, step by step [m]
  std::vector<View> views_;                // by obstacle
  std::optional<std::uint64_t> kicked_;    // at which step
  std::vector<Contact> contacts_, contacts_before_;
  std::vector<Vec3> before_, after_;
  std::optional<std::uint64_t> first_step_;
  std::optional<Passage> passage_;
};

}  // namespace springlod::sim
