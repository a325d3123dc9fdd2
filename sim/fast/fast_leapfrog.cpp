#include "sim/fast/fast_leapfrog.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <thread>
#include <tuple>
#include <utility>

#include "sim/correction/corner_law.hpp"
#include "sim/fast/place.hpp"
#include "sim/integrators/kernel.hpp"

namespace springlod::sim {
namespace {

// Interval between two new frames [steps]. In this time the velocity of a resting body relative to
// its frame grows to a few hundredths of a metre per second, which single precision resolves well.
// A new frame costs about three steps.
constexpr std::uint64_t kFrameEvery = 64;

// Least number of nodes per thread: with fewer, the waits per step cost more than the thread
// saves.
constexpr std::uint32_t kNodesAThread = 2 * kBlockNodes;

double shortest_spring(const MassSpringModel& model) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const double length : model.rest_length) shortest = std::min(shortest, length);
  return shortest;
}

std::uint32_t team_size(std::uint32_t threads, std::uint32_t blocks, std::uint32_t nodes) {
  const std::uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::uint32_t worth = std::max(1U, nodes / kNodesAThread);
  return std::min({threads > 0 ? threads : cores, blocks, worth});
}

}  // namespace

FastLeapfrog::FastLeapfrog(const MassSpringModel& model, const Scenario& scenario,
                           const State& start, double step, const FastOptions& options)
    : Stepper(model, scenario, start, step, options.skin.get(), options.anchors),
      layout_(options.layout ? options.layout : make_fast_model(model, options.precision)),
      body_(layout_->new_body(options.ledger)),
      team_(team_size(options.threads, body_->block_count(), model.node_count())),
      found_(body_->block_count()),
      with_ledger_(options.ledger),
      volumes_(options.volumes),
      correction_({.model = model_,
                   .points = {.points = &points_,
                              .obstacles = &scenario.obstacles,
                              .body = body_.get(),
                              .finder = &finder_,
                              .walls = &walls_},
                   .body = body_.get(),
                   .holds = {.held = &held_, .springs = &anchor_springs_},
                   .gravity = gravity_,
                   .with_ledger = with_ledger_,
                   .volumes = volumes_}),
      anchors_(model, gravity_, held_),
      watch_(*body_, model.node_count(), shortest_spring(model)),
      losses_(body_->block_count()),
      sums_(body_->block_count()),
      v_minus_(start.v),
      v_plus_(start.v),
      v_step_(start.v) {
  finder_.find(x_, start.v, x_, contacts_);
  correction_.start(contacts_);
}

void FastLeapfrog::prepare() {
  anchors_.start(v_minus_);
  share_out([&](Share& share, const MovingFrame& frame) { return observe(share, frame); });
  finish_observation();
}

void FastLeapfrog::advance(std::uint64_t steps) {
  while (steps > 0) {
    const std::uint64_t together = std::min(steps, kFrameEvery - n_ % kFrameEvery);
    share_out([&](Share& share, const MovingFrame& frame) {
      return observe(share, go(together, share, frame));
    });
    steps -= reached_ - n_;
    n_ = reached_;
    throw_if_tunnelled();
    finish_observation();
    if (watch_.stopped()) return;
  }
}

void FastLeapfrog::watch(const Watch& limits) {
  watch_.set(limits);
}

void FastLeapfrog::share_out(const std::function<MovingFrame(Share&, const MovingFrame&)>& work) {
  found_.reset();
  const std::uint32_t count = body_->block_count();
  MovingFrame end;
  team_.run([&](const StepTeam::Member& member) {
    Share share{member, count * member.number / team_.size(),
                count * (member.number + 1) / team_.size()};
    const MovingFrame frame = work(share, frame_);
    if (member.number == 0) end = frame;
  });
  frame_ = end;
}

MovingFrame FastLeapfrog::observe(Share& share, MovingFrame frame) {
  const std::uint64_t number = reached_;
  const bool first = number == start_n_;
  if (!first)
    for (std::uint32_t b = share.first; b < share.end; ++b) {
      body_->get_x(b, frame, x_);
      body_->get_v(b, frame, v_minus_);
    }
  if (first || number % kFrameEvery == 0) frame = take_new_frame(share);
  // The first forces and damping use the start velocities: v+- = v_0 +- dt/2 a.
  frame = pass({.number = number, .kick = first ? 0.5 * step_ : step_}, share, frame);
  for (std::uint32_t b = share.first; b < share.end; ++b) body_->get_v(b, frame, v_plus_);
  return frame;
}

void FastLeapfrog::finish_observation() {
  gather_corrections();
  v_step_ = v_minus_;
  if (n_ != start_n_) {
    for (const NodeChange& change : correction_.changes())
      v_step_[change.node] -= change.by_pressure(step_) / step_;
  } else {
    for (std::size_t i = 0; i < x_.size(); ++i) v_minus_[i] = 2 * v_minus_[i] - v_plus_[i];
  }
  observe_held();
}

void FastLeapfrog::observe_held() {
  if (held_.empty()) return;
  move_anchors(n_ + 1);
  anchors_.observe(step_, x_, v_minus_, v_plus_);
}

// Summed block by block, so that the result does not depend on the threads.
MovingFrame FastLeapfrog::take_new_frame(const Share& share) {
  for (std::uint32_t b = share.first; b < share.end; ++b) {
    sums_[b] = {};
    for (const std::uint32_t node : body_->nodes(b)) {
      sums_[b].origin += x_[node];
      sums_[b].velocity += v_minus_[node];
    }
  }
  share.member.meet();
  MovingFrame sum;
  for (const MovingFrame& of_block : sums_) {
    sum.origin += of_block.origin;
    sum.velocity += of_block.velocity;
  }
  const auto count = static_cast<double>(x_.size());
  MovingFrame frame{sum.origin / count, sum.velocity / count};
  for (std::uint32_t b = share.first; b < share.end; ++b) body_->set(b, frame, x_, v_minus_);
  share.member.meet();
  if (share.member.number == 0) watch_.follow(*body_);
  share.member.meet();
  return frame;
}

bool FastLeapfrog::change_step(double step) {
  const double before = kinetic() + contact_energy(contacts_);
  anchors_.end_step(anchor_forces_);
  v_minus_ = state().v;
  start_time_ = time();
  start_n_ = n_;
  reached_ = n_;
  step_ = step;
  for (Losses& losses : losses_) losses.next = 0;
  prepare();
  lost_to_new_steps_ += before - kinetic() - contact_energy(contacts_);
  return true;
}

MovingFrame FastLeapfrog::after(const Pass& pass, const MovingFrame& frame) const {
  MovingFrame next = frame;
  next.velocity += pass.kick * gravity_;
  next.origin += pass.drift * next.velocity;
  return next;
}

MovingFrame FastLeapfrog::go(std::uint64_t passes, Share& share, MovingFrame frame) {
  for (std::uint64_t i = 0; i < passes; ++i) {
    // The velocities of the first are those after the kick of the last observation.
    frame = pass({.number = n_ + i, .kick = i > 0 ? step_ : 0, .drift = step_}, share, frame);
    if (watch_.stopped()) break;
  }
  return frame;
}

MovingFrame FastLeapfrog::pass(const Pass& pass, Share& share, const MovingFrame& frame) {
  find_and_move(pass, share);
  share.member.meet();
  if (share.member.number == 0 && pass.kick != 0) correction_.book_end();
  if (pass.drift != 0)
    correct(drift_step(pass, frame), share);
  else
    share.member.meet();
  return after(pass, frame);
}

void FastLeapfrog::correct(const FastStep& step, const Share& share) {
  const bool one = share.member.number == 0;
  if (one) {
    reached_ = step.number;
    move_anchors(step.number);
    if (correction_.needed()) correction_.correct(step);
    watch_.plan(step, correction_);
    if (!watch_.looks()) end_look(step);
  }
  share.member.meet();
  while (watch_.looks()) {
    for (std::uint32_t b = share.first; b < share.end; ++b) watch_.look(b, *body_, correction_);
    share.member.meet();
    if (one) end_look(step);
    share.member.meet();
  }
}

void FastLeapfrog::end_look(const FastStep& step) {
  watch_.solve_corners(correction_);
  if (watch_.looks()) return;
  if (correction_.needed()) correction_.finish(step);
  if (!held_.empty()) anchors_.book(step.length, correction_, anchor_forces_);
  correction_.springs().book(anchor_forces_);
  watch_.finish(step, *body_, correction_);
}

void FastLeapfrog::find_and_move(const Pass& pass, Share& share) {
  std::vector<std::uint32_t> later;
  std::uint32_t next = share.first;
  if (pass.kick != 0) {
    ++share.kicks;
    for (std::uint32_t found = share.first; found < share.end; ++found) {
      body_->find_forces(found);
      found_.reach(found, share.kicks);
      for (; next <= found && body_->needs(next).last <= found; ++next) {
        if (body_->needs(next).first < share.first)
          later.push_back(next);
        else
          kick_and_drift(pass, next);
      }
    }
  }
  for (; next < share.end; ++next) later.push_back(next);
  for (const std::uint32_t block : later) {
    if (pass.kick != 0) wait_for_others(block, share);
    kick_and_drift(pass, block);
  }
}

FastStep FastLeapfrog::drift_step(const Pass& pass, const MovingFrame& frame) const {
  const MovingFrame end = after(pass, frame);
  return {.number = pass.number + 1,
          .before = {frame.origin, end.velocity},
          .after = end,
          .length = step_};
}

void FastLeapfrog::wait_for_others(std::uint32_t block, const Share& share) const {
  const FastBody::BlockRange needs = body_->needs(block);
  assert(needs.first <= block && block <= needs.last && needs.last < losses_.size());
  for (std::uint32_t b = needs.first; b <= needs.last; ++b)
    if (b < share.first || b >= share.end) found_.wait_for(b, share.kicks);
}

void FastLeapfrog::kick_and_drift(const Pass& pass, std::uint32_t block) {
  if (pass.kick != 0) body_->collect_forces(block);
  move_block(pass, block);
}

void FastLeapfrog::move_block(const Pass& pass, std::uint32_t block) {
  if (!with_ledger_) return body_->move(block, pass.kick, pass.drift);
  if (pass.kick != 0) kick_and_book(pass, block);
  if (pass.drift != 0) drift_and_book(pass, block);
}

void FastLeapfrog::kick_and_book(const Pass& pass, std::uint32_t block) {
  Losses& losses = losses_[block];
  const auto damping = [&] { return -0.5 * step_ * body_->damping_power(block); };
  if (pass.number > start_n_) losses.until_now += damping();
  body_->move(block, pass.kick, 0);
  losses.next += damping();
}

void FastLeapfrog::drift_and_book(const Pass& pass, std::uint32_t block) {
  losses_[block].until_now += std::exchange(losses_[block].next, 0);
  body_->move(block, 0, pass.drift);
}

void FastLeapfrog::gather_corrections() {
  contacts_ = correction_.contacts();
  if (!first_contact_ && correction_.first_step())
    first_contact_ = time_of(*correction_.first_step());
  take(correction_.inversions());
}

void FastLeapfrog::throw_if_tunnelled() const {
  const std::optional<Passage>& passage = correction_.passage();
  if (passage)
    walls_.throw_tunnelled(passage->wall, passage->number, passage->from, passage->to,
                           time_of(passage->step), step_);
}

std::vector<Vec3> FastLeapfrog::positions_at(double time) const {
  std::vector<Vec3> x = x_;
  const double ahead = time - this->time();
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += ahead * v_plus_[i];
  return x;
}

State FastLeapfrog::state() const {
  State state{x_, v_minus_, time()};
  for (std::size_t i = 0; i < x_.size(); ++i) state.v[i] = 0.5 * (v_minus_[i] + v_plus_[i]);
  return state;
}

double FastLeapfrog::kinetic() const {
  double sum = 0;
  for (std::size_t i = 0; i < x_.size(); ++i)
    sum += 0.5 * model_->mass[i] * v_minus_[i].dot(v_plus_[i]);
  return sum;
}

LedgerEntry FastLeapfrog::ledger_entry() const {
  LedgerEntry entry;
  for (const Losses& losses : losses_) entry.lost_damping += losses.until_now;
  entry.lost_contact = correction_.losses().contact;
  entry.lost_friction = correction_.losses().friction;
  entry.lost_corners = correction_.losses().corners;
  entry.lost_anchors = correction_.losses().anchors;
  entry.lost_switch = lost_to_new_steps_;
  entry.lost_damping += anchors_.lost_damping();
  entry.anchor_work = anchor_work();
  entry.time = time();
  entry.kinetic = kinetic();
  entry.elastic = elastic_energy(*model_, x_) + (volumes_ ? corner_energy(*model_, x_) : 0);
  entry.anchors = correction_.springs().energy();
  entry.gravity = gravity_energy();
  entry.contact = contact_energy(contacts_);
  return entry;
}

}  // namespace springlod::sim
