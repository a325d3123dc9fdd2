#include "sim/fast/fast_leapfrog.hpp"

#include <algorithm>
#include <thread>
#include <tuple>
#include <utility>

#include "sim/contact_losses.hpp"
#include "sim/kernel.hpp"

namespace springlod {
namespace {

// Steps between two new frames [steps]: meanwhile a body at rest falls by no more than a few
// hundredths of a metre a second behind its frame, which single precision resolves well; finding
// the new one costs some three steps.
constexpr std::uint64_t kFrameEvery = 64;

// Threads meet twice a step: below this many nodes each, that costs more than they save.
constexpr std::uint32_t kNodesAThread = 2 * kBlockNodes;

std::uint32_t team_size(std::uint32_t threads, std::uint32_t blocks, std::uint32_t nodes) {
  const std::uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::uint32_t worth = std::max(1U, nodes / kNodesAThread);
  return std::min({threads > 0 ? threads : cores, blocks, worth});
}

void add_losses(const LedgerEntry& more, LedgerEntry& sum) {
  sum.lost_damping += more.lost_damping;
  sum.lost_friction += more.lost_friction;
  sum.lost_contact += more.lost_contact;
}

}  // namespace

FastLeapfrog::FastLeapfrog(const MassSpringModel& model, const Scenario& scenario,
                           const State& start, double step, const StepperOptions& options)
    : Stepper(model, scenario, start, step),
      layout_(options.layout ? options.layout : make_fast_model(model, options.precision)),
      body_(layout_->new_body(options.ledger)),
      team_(team_size(options.threads, body_->block_count(), model.node_count())),
      with_ledger_(options.ledger),
      losses_(body_->block_count()),
      v_minus_(start.v),
      v_plus_(start.v) {
  take_new_frame();
  std::vector<std::vector<std::uint32_t>> numbers(body_->block_count());
  for (std::uint32_t number = 0; number < finder_.nodes().size(); ++number)
    numbers[body_->place(finder_.nodes()[number]).block].push_back(number);
  for (std::uint32_t b = 0; b < body_->block_count(); ++b)
    contacts_of_.emplace_back(model, scenario.obstacles, b, std::move(numbers[b]), *body_, finder_,
                              walls_);
}

void FastLeapfrog::take_new_frame() {
  Vec3 x = Vec3::Zero();
  Vec3 v = Vec3::Zero();
  for (std::size_t i = 0; i < x_.size(); ++i) {
    x += x_[i];
    v += v_minus_[i];
  }
  const auto count = static_cast<double>(x_.size());
  frame_ = {x / count, v / count};
  std::vector<Vec3> own_x(x_.size());
  std::vector<Vec3> own_v(x_.size());
  for (std::size_t i = 0; i < x_.size(); ++i) {
    own_x[i] = x_[i] - frame_.origin;
    own_v[i] = v_minus_[i] - frame_.velocity;
  }
  body_->set(own_x, own_v);
}

void FastLeapfrog::read_positions() {
  body_->get_x(x_);
  for (Vec3& x : x_) x += frame_.origin;
}

void FastLeapfrog::read_velocities(std::vector<Vec3>& v) const {
  body_->get_v(v);
  for (Vec3& one : v) one += frame_.velocity;
}

void FastLeapfrog::prepare() {
  const bool first = n_ == start_n_;
  if (!first) {
    read_positions();
    read_velocities(v_minus_);
    if (n_ % kFrameEvery == 0) take_new_frame();
    go({{.number = n_, .kick = step_}});
  } else {
    // Forces and damping with the velocities of the start itself: v+- = v_0 +- dt/2 a.
    go({{.number = n_, .kick = 0.5 * step_}});
  }
  read_velocities(v_plus_);
  gather_contacts();
  if (!first) return;
  for (std::size_t i = 0; i < x_.size(); ++i) v_minus_[i] = 2 * v_minus_[i] - v_plus_[i];
  for (const Contact& c : contacts_) v_minus_[c.node] += c.slip_change;  // no part of a
}

void FastLeapfrog::advance(std::uint64_t steps) {
  while (steps > 0) {
    const std::uint64_t together = std::min(steps, kFrameEvery - n_ % kFrameEvery);
    std::vector<Pass> passes{{.number = n_, .drift = step_}};
    for (std::uint64_t i = 1; i < together; ++i)
      passes.push_back({.number = n_ + i, .kick = step_, .drift = step_});
    go(passes);
    n_ += together;
    steps -= together;
    throw_if_tunnelled();
    prepare();
  }
}

bool FastLeapfrog::change_step(double step) {
  const double before = kinetic();
  v_minus_ = state().v;
  start_time_ = time();
  start_n_ = n_;
  step_ = step;
  for (Losses& losses : losses_) losses.next = {};
  take_new_frame();
  prepare();
  lost_to_new_steps_ += before - kinetic();
  return true;
}

MovingFrame FastLeapfrog::after(const Pass& pass, const MovingFrame& frame) const {
  MovingFrame next = frame;
  next.velocity += pass.kick * gravity_;
  next.origin += pass.drift * next.velocity;
  return next;
}

void FastLeapfrog::go(const std::vector<Pass>& passes) {
  team_.run([&](const StepTeam::Member& member) {
    MovingFrame frame = frame_;
    for (const Pass& pass : passes) {
      find_and_move(pass, frame, member);
      frame = after(pass, frame);
      member.meet();
    }
  });
  for (const Pass& pass : passes) frame_ = after(pass, frame_);
}

void FastLeapfrog::find_and_move(const Pass& pass, const MovingFrame& frame,
                                 const StepTeam::Member& member) {
  const std::uint32_t count = body_->block_count();
  const std::uint32_t first = count * member.number / team_.size();
  const std::uint32_t end = count * (member.number + 1) / team_.size();
  std::uint32_t found = first;  // own blocks before this one have found their forces
  std::vector<std::uint32_t> later;
  std::uint32_t next = first;
  const bool finds = pass.kick != 0;
  for (; finds && found < end; ++found) {
    body_->find_forces(found);
    for (; next <= found; ++next) {
      const FastBody::BlockRange needs = body_->needs(next);
      if (needs.last > found) break;
      if (needs.first < first)
        later.push_back(next);
      else
        kick_and_drift(pass, frame, next);
    }
  }
  if (finds) member.meet();
  for (const std::uint32_t block : later) kick_and_drift(pass, frame, block);
  for (; next < end; ++next) kick_and_drift(pass, frame, next);
}

void FastLeapfrog::kick_and_drift(const Pass& pass, const MovingFrame& frame, std::uint32_t block) {
  BlockContacts& contacts = contacts_of_[block];
  const MovingFrame next = after(pass, frame);
  const MovingFrame kicked{frame.origin, next.velocity};
  if (pass.kick != 0) {
    body_->collect_forces(block);
    contacts.press(pass.number, frame, step_);
  }
  contacts.leave();
  if (pass.kick != 0 && pass.drift != 0 && !with_ledger_ && contacts.now().empty()) {
    body_->move(block, pass.kick, pass.drift);
  } else {
    if (pass.kick != 0) kick(pass, frame, kicked, block);
    if (pass.drift == 0) return;
    add_losses(losses_[block].next, losses_[block].until_now);
    losses_[block].next = {};
    body_->move(block, 0, pass.drift);
  }
  contacts.watch(pass.number + 1, kicked, next, step_);
}

void FastLeapfrog::kick(const Pass& pass, const MovingFrame& frame, const MovingFrame& kicked,
                        std::uint32_t block) {
  BlockContacts& contacts = contacts_of_[block];
  Losses& losses = losses_[block];
  std::vector<Vec3> v_minus;  // of the nodes in contact
  if (with_ledger_) {
    for (const Contact& c : contacts.now()) v_minus.push_back(contacts.velocity(c, frame));
    if (pass.number > start_n_)
      losses.until_now.lost_damping -= 0.5 * step_ * body_->damping_power(block);
  }
  body_->move(block, pass.kick, 0);
  contacts.rub(kicked, step_);
  if (!with_ledger_) return;
  losses.next.lost_damping = -0.5 * step_ * body_->damping_power(block);
  for (std::size_t i = 0; i < v_minus.size(); ++i) {
    const Contact& c = contacts.now()[i];
    const double mass = model_->mass[c.node];
    if (pass.number > start_n_) book_contact(c, mass, step_, v_minus[i], -step_, losses.until_now);
    book_contact(c, mass, step_, contacts.velocity(c, kicked), step_, losses.next);
  }
}

void FastLeapfrog::gather_contacts() {
  contacts_.clear();
  std::optional<std::uint64_t> first;
  for (const BlockContacts& block : contacts_of_) {
    contacts_.insert(contacts_.end(), block.now().begin(), block.now().end());
    const auto& step = block.first_step();
    if (step && (!first || *step < *first)) first = step;
  }
  if (first && !first_contact_) first_contact_ = time_of(*first);
}

void FastLeapfrog::throw_if_tunnelled() const {
  const Passage* earliest = nullptr;
  for (const BlockContacts& block : contacts_of_) {
    const auto& passage = block.passage();
    if (!passage) continue;
    const auto rank = [](const Passage& p) { return std::tuple(p.step, p.wall, p.number); };
    if (earliest == nullptr || rank(*passage) < rank(*earliest)) earliest = &*passage;
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
  for (const Losses& losses : losses_) add_losses(losses.until_now, entry);
  entry.lost_switch = lost_to_new_steps_;
  entry.time = time();
  entry.kinetic = kinetic();
  entry.elastic = elastic_energy(*model_, x_);
  entry.gravity = gravity_energy();
  entry.contact = contact_energy(contacts_);
  return entry;
}

}  // namespace springlod
