#include "sweep/run_plan.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <deque>
#include <fstream>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "base/error.hpp"
#include "sweep/pack_tasks.hpp"
#include "sweep/worker.hpp"

namespace springlod::sweep {

namespace {

namespace fs = std::filesystem;

/// Processes that end without having run a unit, one after another, before the run is given up.
constexpr int kMostIdleEnds = 3;
/// Between two looks whether the user stops the run, or at units that others are running [ms].
constexpr int kLook = 200;
/// Orders for each worker in what is left: towards the end all have work.
constexpr double kOrdersEach = 4;
/// An order is at least this long, so that sending it costs nothing [s].
constexpr double kShortestOrder = 0.2;

/// Signals by which a program ends that has an error itself.
bool is_crash(int signal) {
  constexpr std::array kCrashes{SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP};
  return std::find(kCrashes.begin(), kCrashes.end(), signal) != kCrashes.end();
}

std::string last_line_of(const fs::path& log) {
  std::ifstream file(log);
  std::string line, last;
  while (std::getline(file, line))
    if (!line.empty()) last = line;
  constexpr std::string_view kPrefix = "springlod: ";
  return last.starts_with(kPrefix) ? last.substr(kPrefix.size()) : last;
}

/// Why a process could not go on, as far as it has said.
std::string error_of(const Worker& worker) {
  if (!worker.error().empty()) return worker.error();
  const std::string last = last_line_of(worker.log());
  return last.empty() ? "it has printed nothing; the disk may be full" : last;
}

/// Neighbouring units that are to be run.
using Range = Order;

/// The units of a phase that are to be run, and those that others are running.
class Queue {
 public:
  Queue(const UnitFiles& files, const Range& units) : files_(files), units_(units) { look(); }

  bool empty() const { return ranges_.empty(); }
  std::uint64_t left() const { return left_; }
  bool waits_for_others() const { return !elsewhere_.empty(); }

  Range take(std::uint64_t most) {
    Range& front = ranges_.front();
    const Range taken{front.first, std::min(front.end, front.first + most)};
    front.first = taken.end;
    if (front.first == front.end) ranges_.pop_front();
    left_ -= taken.end - taken.first;
    return taken;
  }
  void put_back(const Range& range) {
    if (range.first >= range.end) return;
    ranges_.push_front(range);
    left_ += range.end - range.first;
  }
  /// Looks at all units of the stage. The queue must be empty.
  void look() {
    elsewhere_.clear();
    const std::vector<UnitNotes> notes = files_.list(units_.first, units_.end);
    for (std::uint64_t unit = units_.first; unit < units_.end; ++unit) {
      const UnitState state = notes[unit - units_.first].state;
      if (needs_run(state)) append(unit);
      if (state == UnitState::running) elsewhere_.push_back(unit);
    }
  }
  /// Looks again at units that others were running: those that were lost are to be run here.
  void look_at_others() {
    const std::vector<UnitNotes> notes = files_.list(elsewhere_);
    std::vector<std::uint64_t> still;
    for (std::size_t i = 0; i < notes.size(); ++i) {
      if (needs_run(notes[i].state)) append(elsewhere_[i]);
      if (notes[i].state == UnitState::running) still.push_back(elsewhere_[i]);
    }
    elsewhere_ = std::move(still);
  }

 private:
  void append(std::uint64_t unit) {
    if (ranges_.empty() || ranges_.back().end != unit) ranges_.push_back({unit, unit});
    ranges_.back().end = unit + 1;
    ++left_;
  }

  const UnitFiles& files_;
  Range units_;
  std::deque<Range> ranges_;
  std::uint64_t left_ = 0;
  std::vector<std::uint64_t> elsewhere_;
};

class PhaseRun {
 public:
  PhaseRun(const Plan& plan, const UnitFiles& files, const RunOptions& options, Range units,
           RunCounts& counts)
      : plan_(plan),
        files_(files),
        options_(options),
        queue_(files, units),
        counts_(counts),
        seconds_each_(seconds_each(plan, units)) {}

  void run() {
    if (queue_.empty() && !queue_.waits_for_others()) return;
    Task task(options_.progress, options_.task ? "units of the task" : "units", queue_.left());
    while (has_work()) {
      task.advance(0);  // throws if the user stops it
      fill();
      wait(task);
    }
    for (Place& place : places_) place.worker->leave();
    places_.clear();
  }

 private:
  struct Place {
    std::unique_ptr<Worker> worker{};
    bool ready = false;
    Range order{};                    // what is left of it
    std::optional<Report> in_work{};  // the unit that it has begun
  };

  static double seconds_each(const Plan& plan, Range units) {
    double sum = 0;
    for_each_unit(plan, [&](std::uint64_t unit, double cost) {
      if (unit >= units.first && unit < units.end) sum += cost;
    });
    return sum * plan.seconds_per_cost / static_cast<double>(units.end - units.first);
  }

  bool is_busy() const {
    return std::any_of(places_.begin(), places_.end(),
                       [](const Place& place) { return !place.ready; });
  }

  /// Whether a unit is to be run, or somebody runs one: the next stage needs them all.
  bool has_work() {
    if (!queue_.empty() || is_busy()) return true;
    if (queue_.waits_for_others()) queue_.look_at_others();
    // Others may have begun units that were free at the first look.
    if (queue_.empty() && !queue_.waits_for_others()) queue_.look();
    return !queue_.empty() || queue_.waits_for_others();
  }

  std::uint64_t order_size() const {
    const auto share = static_cast<double>(queue_.left()) / (kOrdersEach * options_.workers);
    const double shortest = seconds_each_ > 0 ? kShortestOrder / seconds_each_ : 1;
    const double longest = seconds_each_ > 0 ? kShortestTask / seconds_each_ : share;
    return static_cast<std::uint64_t>(std::max(1.0, std::min(std::max(share, shortest), longest)));
  }

  /// Gives each worker that waits an order, and starts workers while there is more to do.
  void fill() {
    for (Place& place : places_) give_order(place);
    while (!queue_.empty() && places_.size() < options_.workers) start();
  }

  void start() {
    const fs::path log =
        fs::path("logs") / fmt::format("{}-{}-{}.log", host_name(), ::getpid(), started_++);
    places_.push_back(
        {.worker = std::make_unique<Worker>(options_.program, options_.arguments(log.string()),
                                            files_.folder() / log, plan_.folder)});
  }

  void give_order(Place& place) {
    if (!place.ready || queue_.empty()) return;
    place.order = queue_.take(order_size());
    place.ready = false;
    place.worker->send(place.order);
  }

  void wait(Task& task) {
    std::vector<pollfd> sockets;
    for (const Place& place : places_) sockets.push_back({place.worker->socket(), POLLIN, 0});
    ::poll(sockets.data(), sockets.size(), kLook);
    for (std::size_t i = sockets.size(); i-- > 0;)  // from behind, as an ended worker is removed
      if (sockets[i].revents != 0) read(i, task);
  }

  void read(std::size_t i, Task& task) {
    Place& place = places_[i];
    const bool goes_on = place.worker->read_more();
    while (const auto report = place.worker->take_report()) note(place, *report, task);
    if (goes_on) return;
    Place ended = std::move(place);
    places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i));
    handle_end(ended, task);
  }

  void note(Place& place, const Report& report, Task& task) {
    using Kind = Report::Kind;
    idle_ends_ = 0;
    if (report.kind == Kind::ready) {
      place.ready = true;
      // Units of an order that needed no run were done by others.
      task.advance(place.order.end - place.order.first);
      place.order = {};
      place.in_work.reset();
      return;
    }
    if (report.kind == Kind::begun) {
      task.advance(report.unit - place.order.first);
      place.order.first = report.unit;
      place.in_work = report;
      return;
    }
    ++(report.kind == Kind::done ? counts_.done : counts_.failed);
    finish_unit(place, task);
  }

  void finish_unit(Place& place, Task& task) {
    ++place.order.first;
    place.in_work.reset();
    task.advance();
  }

  void handle_end(Place& place, Task& task) {
    const ProcessEnd end = place.worker->wait();
    if (end.signal == 0) task.advance(0);  // throws if the user stops it: the worker was as well
    const bool exits_in_unit = place.in_work && place.worker->error().empty();
    if (end.signal == 0 && !exits_in_unit)
      throw IoError(fmt::format("a process of the sweep cannot work: {} (see {})",
                                error_of(*place.worker), place.worker->log().string()));
    if (!place.in_work && ++idle_ends_ >= kMostIdleEnds)
      throw IoError(
          fmt::format("processes of the sweep end by signal {} before they run a unit "
                      "(see {})",
                      end.signal, place.worker->log().string()));
    if (place.in_work) handle_lost_unit(place, end, task);
    queue_.put_back(place.order);
  }

  void handle_lost_unit(Place& place, const ProcessEnd& end, Task& task) {
    const Report in_work = *place.in_work;
    const bool exits = end.signal == 0;  // os.exit in the script
    if (exits || is_crash(end.signal)) {
      UnitResult failure{
          .unit = in_work.unit,
          .failure = exits ? fmt::format("ended its process with exit code {}", end.exit_code)
                           : fmt::format("crashed by signal {}", end.signal),
          .version = plan_.version,
          .host = host_name(),
          .log = fs::relative(place.worker->log(), files_.folder()).string(),
          .signal = end.signal};
      files_.finish(failure);
      ++counts_.failed;
      finish_unit(place, task);
      return;
    }
    files_.note_signal(in_work.unit, in_work.number, end.signal);
    if (in_work.number < kMostTries) return;
    ++counts_.lost;
    finish_unit(place, task);
  }

  const Plan& plan_;
  const UnitFiles& files_;
  const RunOptions& options_;
  Queue queue_;
  RunCounts& counts_;
  double seconds_each_;
  std::vector<Place> places_;
  int started_ = 0;
  int idle_ends_ = 0;
};

}  // namespace

RunCounts run_plan(const Plan& plan, const UnitFiles& files, const RunOptions& options) {
  RunCounts counts;
  if (options.task) {
    const Range units{plan.tasks.at(*options.task), plan.end_of_task(*options.task)};
    PhaseRun(plan, files, options, units, counts).run();
    return counts;
  }
  for (const Phase& phase : plan.phases()) {
    RunOptions of_phase = options;
    if (phase.alone) of_phase.workers = 1;
    PhaseRun(plan, files, of_phase, {plan.first_unit(phase.first), plan.first_unit(phase.end)},
             counts)
        .run();
  }
  return counts;
}

}  // namespace springlod::sweep
