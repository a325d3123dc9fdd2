#include "sim/fast/fast_leapfrog.hpp"

#include <algorithm>
#include <cassert>
#include <thread>
#include <tuple>
#include <utility>

#include "sim/integrators/kernel.hpp"

namespace springlod::sim {
namespace {

// Interval between two new frames [steps]. In this time the velocity of a resting body relative to
// its frame grows to a few hundredths of a metre per second, which single precision resolves well.
// A new frame costs about three steps.
constexpr std::uint64_t kFrameEvery = 64;

// Least number of nodes per thread: with fewer, the two waits per step cost more than the thread
// saves.
constexpr std::uint32_t kNodesAThread = 2 * kBlockNodes;

std::uint32_t team_size(std::uint32_t threads, std::uint32_t blocks, std::uint32_t nodes) {
  const std::uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::uint32_t worth = std::max(1U, nodes / kNodesAThread);
  return std::min({threads > 0 ? threads : cores, blocks, worth});
}

}  // namespace

FastLeapfrog::FastLeapfrog(const MassSpringModel& model, const Scenario& scenario,
                           const State& start, double step, const FastOptions& options)
    : Stepper(model, scenario, start, step, options.skin.get()),
      layout_(options.layout ? options.layout : make_fast_model(model, options.precision)),
      body_(layout_->new_body(options.ledger)),
      team_(team_size(options.threads, body_->block_count(), model.node_count())),
      found_(body_->block_count()),
      with_ledger_(options.ledger),
      losses_(body_->block_count()),
      sums_(body_->block_count()),
      v_minus_(start.v),
      v_plus_(start.v),
      v_step_(start.v) {
  const FastContacts::Shared shared{.model = model_,
                                    .points = &points_,
                                    .obstacles = &scenario.obstacles,
                                    .body = body_.get(),
                                    .finder = &finder_,
                                    .walls = &walls_,
                                    .gravity = gravity_,
                                    .with_ledger = with_ledger_};
  finder_.find(x_, start.v, contacts_);
  if (options.skin) {
    skin_.emplace(shared);
    skin_->start(contacts_);
    return;
  }
  std::vector<std::vector<std::uint32_t>> numbers(body_->block_count());
  for (std::uint32_t p = 0; p < points_.count(); ++p)
    numbers[body_->place(points_.number(p)).block].push_back(p);
  std::vector<std::vector<Contact>> contacts(body_->block_count());
  for (const Contact& c : contacts_)
    contacts[body_->place(points_.number(c.point)).block].push_back(c);
  for (std::uint32_t b = 0; b < body_->block_count(); ++b) {
    block_contacts_.emplace_back(shared, b, std::move(numbers[b]));
    block_contacts_.back().start(std::move(contacts[b]));
  }
}

void FastLeapfrog::prepare() {
  share_out([&](Share& share, const MovingFrame& frame) { return observe(share, frame); });
  finish_observation();
}

void FastLeapfrog::advance(std::uint64_t steps) {
  while (steps > 0) {
    const std::uint64_t together = std::min(steps, kFrameEvery - n_ % kFrameEvery);
    std::vector<Pass> passes{{.number = n_, .drift = step_}};
    for (std::uint64_t i = 1; i < together; ++i)
      passes.push_back({.number = n_ + i, .kick = step_, .drift = step_});
    n_ += together;
    steps -= together;
    share_out([&](Share& share, const MovingFrame& frame) {
      return observe(share, go(passes, share, frame));
    });
    throw_if_tunnelled();
    finish_observation();
  }
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
  const bool first = n_ == start_n_;
  if (!first)
    for (std::uint32_t b = share.first; b < share.end; ++b) {
      body_->get_x(b, frame, x_);
      body_->get_v(b, frame, v_minus_);
    }
  if (first || n_ % kFrameEvery == 0) frame = take_new_frame(share);
  // The first forces and damping use the start velocities: v+- = v_0 +- dt/2 a.
  frame = go({{.number = n_, .kick = first ? 0.5 * step_ : step_}}, share, frame);
  for (std::uint32_t b = share.first; b < share.end; ++b) body_->get_v(b, frame, v_plus_);
  return frame;
}

void FastLeapfrog::finish_observation() {
  gather_contacts();
  v_step_ = v_minus_;
  if (n_ != start_n_) {
    for (const FastContacts* set : contact_sets())
      for (const NodeChange& change : set->changes())
        v_step_[change.node] -= change.by_pressure(step_) / step_;
    return;
  }
  for (std::size_t i = 0; i < x_.size(); ++i) v_minus_[i] = 2 * v_minus_[i] - v_plus_[i];
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
  return frame;
}

bool FastLeapfrog::change_step(double step) {
  const double before = kinetic() + contact_energy(contacts_);
  v_minus_ = state().v;
  start_time_ = time();
  start_n_ = n_;
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

MovingFrame FastLeapfrog::go(const std::vector<Pass>& passes, Share& share, MovingFrame frame) {
  for (const Pass& pass : passes) {
    find_and_move(pass, frame, share);
    if (skin_) correct_skin(pass, frame, share);
    frame = after(pass, frame);
    share.member.meet();
  }
  return frame;
}

void FastLeapfrog::find_and_move(const Pass& pass, const MovingFrame& frame, Share& share) {
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
          kick_and_drift(pass, frame, next);
      }
    }
  }
  for (; next < share.end; ++next) later.push_back(next);
  for (const std::uint32_t block : later) {
    if (pass.kick != 0) wait_for_others(block, share);
    kick_and_drift(pass, frame, block);
  }
}

void FastLeapfrog::correct_skin(const Pass& pass, const MovingFrame& frame, const Share& share) {
  share.member.meet();
  if (share.member.number != 0) return;
  if (pass.kick != 0) skin_->book_end();
  if (pass.drift != 0) skin_->correct(drift_step(pass, frame));
}

FastContacts::Step FastLeapfrog::drift_step(const Pass& pass, const MovingFrame& frame) const {
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

void FastLeapfrog::kick_and_drift(const Pass& pass, const MovingFrame& frame, std::uint32_t block) {
  BlockContacts* contacts = skin_ ? nullptr : &block_contacts_[block];
  if (pass.kick != 0) {
    body_->collect_forces(block);
    if (contacts != nullptr) contacts->book_end();
  }
  if (contacts != nullptr) contacts->start_drift();
  move_block(pass, block);
  if (contacts != nullptr && pass.drift != 0) contacts->correct(drift_step(pass, frame));
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

std::vector<const FastContacts*> FastLeapfrog::contact_sets() const {
  std::vector<const FastContacts*> sets;
  for (const BlockContacts& block : block_contacts_) sets.push_back(&block);
  if (skin_) sets.push_back(&*skin_);
  return sets;
}

void FastLeapfrog::gather_contacts() {
  contacts_.clear();
  std::optional<std::uint64_t> first;
  for (const FastContacts* set : contact_sets()) {
    contacts_.insert(contacts_.end(), set->now().begin(), set->now().end());
    const std::optional<std::uint64_t>& step = set->first_step();
    if (step && (!first || *step < *first)) first = step;
  }
  if (first && !first_contact_) first_contact_ = time_of(*first);
}

void FastLeapfrog::throw_if_tunnelled() const {
  const Passage* earliest = nullptr;
  const auto rank = [](const Passage& p) { return std::tuple(p.step, p.wall, p.number); };
  for (const FastContacts* set : contact_sets()) {
    const std::optional<Passage>& passage = set->passage();
    if (passage && (earliest == nullptr || rank(*passage) < rank(*earliest))) earliest = &*passage;
  }
  if (earliest != nullptr)
    walls_.throw_tunnelled(earliest->wall, earliest->number, earliest->from, earliest->to,
                           time_of(earliest->step), step_);
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
  for (const FastContacts* set : contact_sets()) {
    entry.lost_contact += set->losses().contact;
    entry.lost_friction += set->losses().friction;
  }
  entry.lost_switch = lost_to_new_steps_;
  entry.time = time();
  entry.kinetic = kinetic();
  entry.elastic = elastic_energy(*model_, x_);
  entry.gravity = gravity_energy();
  entry.contact = contact_energy(contacts_);
  return entry;
}

}  // namespace springlod::sim
