#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/step_contacts.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/fast/fast_body.hpp"
#include "sim/fast/passage.hpp"
#include "sim/fast/regions.hpp"

namespace springlod::sim {

/// The contacts of a set of points of a fast body: the nodes of one block, or a whole skin. Solves
/// them after each drift and shifts the nodes: see StepContacts. The derived classes decide which
/// points are checked, and when.
class FastContacts {
 public:
  /// One drift of the body.
  struct Step {
    std::uint64_t number = 0;  ///< of the step at its end
    MovingFrame before, after;
    double length = 0;  ///< dt [s]
  };

  /// Data shared by all sets of one body; must outlive them.
  struct Shared {
    const MassSpringModel* model;
    const ContactPoints* points;
    const std::vector<Obstacle>* obstacles;
    FastBody* body;
    ContactFinder* finder;
    TunnelCheck* walls;
    Vec3 gravity;      ///< [m/s2]
    bool with_ledger;  ///< record the losses
  };

  virtual ~FastContacts() = default;

  /// Sets the contacts at the start.
  void start(std::vector<Contact> contacts) { solver_.set(std::move(contacts)); }
  /// Solves the contacts of a drift that the body has just done, and shifts its nodes.
  virtual void correct(const Step& step) = 0;
  /// Books the part of the losses that depends on the forces at the end of the last step. Call it
  /// when the body has collected them.
  void book_end();

  const std::vector<Contact>& now() const { return solver_.now(); }
  /// How the contacts changed the nodes in the last step.
  const std::vector<NodeChange>& changes() const { return solver_.changes(); }
  /// Losses so far.
  const StepContacts::Losses& losses() const { return losses_; }
  /// Number of the first step with a contact.
  const std::optional<std::uint64_t>& first_step() const { return first_step_; }
  /// The first point that tunnelled through a wall.
  const std::optional<Passage>& passage() const { return passage_; }

 protected:
  /// `number_count`: see StepContacts.
  FastContacts(const Shared& shared, std::uint32_t number_count);
  FastContacts(const FastContacts&) = default;
  FastContacts(FastContacts&&) = default;

  const MassSpringModel& model() const { return *shared_.model; }
  const ContactPoints& points() const { return *shared_.points; }
  const std::vector<Obstacle>& obstacles() const { return *shared_.obstacles; }
  FastBody& body() const { return *shared_.body; }
  ContactFinder& finder() const { return *shared_.finder; }
  StepContacts& solver() { return solver_; }

  /// Solves the contacts that were checked, and shifts the nodes. Arguments as for StepContacts.
  template <class PathOf, class NumberOf>
  void solve(const Step& step, const PathOf& path_of, const NumberOf& number_of) {
    solver_.solve(path_of, number_of);
    apply(step);
  }
  /// Whether any of the paths within `swept` [m] may go through a wall.
  bool near_wall(const Box3& swept) const;
  /// Checks whether points tunnelled through a wall. path_of(point): its path in the step.
  template <class PathOf>
  void check_walls(std::uint64_t number, const std::vector<std::uint32_t>& points,
                   const PathOf& path_of) {
    for (std::size_t w = 0; w < shared_.walls->wall_count(); ++w)
      for (const std::uint32_t point : points) {
        const StepContacts::Path path = path_of(point);
        check_wall({number, w, point, path.from, path.to});
      }
  }

 private:
  void apply(const Step& step);
  /// Half the work of the elastic forces and of gravity on a node over a displacement [J].
  double half_work(std::uint32_t node, const Vec3& displacement) const;
  void check_wall(const Passage& passage);

  Shared shared_;
  StepContacts solver_;
  double booked_step_ = 0;  // length of the step whose end is not booked yet; 0: none [s]
  StepContacts::Losses losses_;
  std::optional<std::uint64_t> first_step_;
  std::optional<Passage> passage_;
};

}  // namespace springlod::sim
