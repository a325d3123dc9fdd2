#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/fast/fast_body.hpp"
#include "sim/fast/passage.hpp"

namespace springlod::sim {

/// What the nodes of one block touch. An obstacle costs nothing while the block's bounds are clear
/// of it.
class BlockContacts {
 public:
  /// `points`: nodes with an area; `numbers`: which of them are the block's. Finder and watch are
  /// those of the whole body, which the blocks share; all but the numbers must outlive this.
  BlockContacts(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
                std::uint32_t block, std::vector<std::uint32_t> numbers, FastBody& body,
                ContactFinder& finder, TunnelWatch& walls);

  /// Finds the contacts at the places of step number n, and adds their normal forces to the body.
  /// `step`: dt [s].
  void press(std::uint64_t n, const MovingFrame& frame, double step);
  /// Adds friction to the forces that the body is about to be kicked with, over `kick` seconds;
  /// `frame` as of after the kick.
  void rub(const MovingFrame& frame, double kick, double step);
  /// Before the drift: keeps the bounds.
  void leave() { bounds_before_ = body_->bounds(block_); }
  /// After the drift to step number n: whether nodes went through a wall. `before`, `after`: the
  /// frame at its ends.
  void watch(std::uint64_t n, const MovingFrame& before, const MovingFrame& after, double step);

  const std::vector<Contact>& now() const { return contacts_; }
  /// Number of the first step with a contact.
  const std::optional<std::uint64_t>& first_step() const { return first_step_; }
  /// The first node that went through a wall.
  const std::optional<Passage>& passage() const { return passage_; }
  /// Of the node of a contact [m/s].
  Vec3 velocity(const Contact& contact, const MovingFrame& frame) const;

 private:
  void press_node(std::uint64_t n, std::size_t obstacle, std::uint32_t index,
                  const MovingFrame& frame, double step);

  Place place(std::uint32_t point) const { return body_->place(points_->number(point)); }

  const ContactPoints* points_;
  const std::vector<Obstacle>* obstacles_;
  std::uint32_t block_;
  FastBody* body_;
  ContactFinder* finder_;
  TunnelWatch* walls_;
  std::vector<std::uint32_t> numbers_;                 // which points are the block's
  std::vector<std::uint32_t> number_of_;               // by index in the block; kNone
  std::vector<std::vector<std::uint64_t>> looked_at_;  // by obstacle and index: last step, plus 1
  std::vector<std::uint32_t> found_;                   // indices, kept for their memory
  std::vector<Contact> contacts_;
  std::optional<std::uint64_t> first_step_;
  std::optional<Passage> passage_;
  Box3 bounds_before_;
};

}  // namespace springlod::sim
