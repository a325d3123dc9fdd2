#include "lod/calibration/calibration_store.hpp"

#include <span>
#include <system_error>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/packed.hpp"

namespace springlod::lod {

namespace fs = std::filesystem;

namespace {

/// Format version. Raise it whenever a fit continues differently from the same state or the format
/// changes; files of other versions are ignored.
constexpr std::uint32_t kFormat = 7;
constexpr std::size_t kChecksumSize = 16;  // of content_hash [bytes]

const char* const kAbout =
    "State of a springlod calibration. A stopped call resumes from here when it is repeated; "
    "without "
    "this folder it starts from the beginning.\n";

void pack(Packer& to, const MassSpringModel& model) {
  to.add(model.rest);
  to.add(model.mass);
  to.add(model.volume);
  to.add(model.border);
  to.add(model.material);
  to.add(model.a);
  to.add(model.b);
  to.add(model.rest_length);
  to.add(model.stiffness);
  to.add(model.damping);
  to.add(model.dilatation.modulus);
  to.add(model.dilatation.damping_time);
  to.add(model.dilatation.start);
  to.add(model.dilatation.node);
  to.add(model.dilatation.gradient);
}

void pack(Packer& to, const Groups& groups) {
  to.add(groups.of);
  to.add(groups.count);
}

void pack(Packer& to, const Support& support) {
  to.add(support.nodes);
  for (const NodeSpring& spring : support.springs) {
    to.add(spring.node);
    to.add(spring.stiffness);
  }
}

template <class Number>
requires std::is_arithmetic_v<Number>
void pack(Packer& to, Number number) {
  to.add(number);
}

template <class Number>
requires std::is_arithmetic_v<Number>
void take(Unpacker& from, Number& number) {
  number = from.take<Number>();
}

void pack(Packer& to, const FitPoint& point) {
  to.add(std::span<const double>(point.theta.data(), static_cast<std::size_t>(point.theta.size())));
  to.add(point.mass);
}

void take(Unpacker& from, FitPoint& point) {
  const std::vector<double> theta = from.take_list<double>();
  point.theta =
      Eigen::Map<const Eigen::VectorXd>(theta.data(), static_cast<Eigen::Index>(theta.size()));
  point.mass = from.take_list<double>();
}

void pack(Packer& to, const std::optional<FitPoint>& point) {
  to.add(point.has_value());
  if (point) pack(to, *point);
}

void take(Unpacker& from, std::optional<FitPoint>& point) {
  if (from.take<bool>()) take(from, point.emplace());
}

/// Visits the members of a state in the order of the file.
template <class State, class Visit>
void visit_members(State& state, const Visit& visit) {
  visit(state.iteration);
  visit(state.finished);
  visit(state.bound.bound);
  visit(state.bound.within);
  visit(state.bound.merit);
  visit(state.bound.steps);
  visit(state.bound.idle);
  visit(state.bound.refined);
  visit(state.bound.took_back);
  for (auto& slack : state.bound.slack) visit(slack);
  visit(state.damping);
  visit(state.increase);
  visit(state.now);
  visit(state.best);
  visit(state.best_frequency);
  visit(state.frequency_error);
}

/// Adds the values of an options struct, row by row; the weights only if `with_weights`.
template <HasOptions S>
void pack_options(Packer& to, const S& all, bool with_weights) {
  for_each_option(all, [&](const auto& row, const auto& member) {
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (requires { row.is_weight; })
      if (row.is_weight && !with_weights) return;
    if constexpr (std::is_enum_v<Member>) {
      to.add(static_cast<int>(member));
    } else if constexpr (requires {
                           typename Member::value_type;
                           requires HasOptions<typename Member::value_type>;
                         }) {
      to.add(member.size());
      for (const auto& each : member) pack_options(to, each, with_weights);
    } else if constexpr (std::is_same_v<Member, Support>) {
      pack(to, member);
    } else if constexpr (requires { member.has_value(); }) {
      to.add(member.has_value());
      if (member) to.add(*member);
    } else {
      to.add(member);
    }
  });
}

std::string name_of_measurements(std::size_t part) {
  return fmt::format("base-part-{}", part + 1);
}

std::string name_of_fit(std::size_t level, std::size_t part) {
  return fmt::format("level-{}-part-{}", level, part + 1);
}

}  // namespace

std::string fingerprint_of(const MassSpringModel& base_part, const TargetOptions& options,
                           const std::vector<Groups>& levels) {
  Packer all;
  pack(all, base_part);
  TargetOptions measured = options;
  measured.patches = patch_count(options, base_part.node_count());
  pack_options(all, measured, false);
  for (const Groups& level : levels) pack(all, level);
  return content_hash(all.bytes());
}

std::string fingerprint_of(const ElasticTargets& targets, const MassSpringModel& level_part,
                           const Groups& of_base, const FitOptions& options) {
  Packer all;
  all.add(targets.squared_frequency);
  all.add(targets.mode_weight);
  for (const std::vector<Vec3>& force : targets.modal_forces) all.add(force);
  all.add(targets.shape_weight);
  for (const LoadTarget& target : targets.loads) {
    all.add(static_cast<int>(target.kind));
    all.add(target.load.force);
    all.add(target.compliance);
    all.add(target.weight);
  }
  all.add(targets.highest_frequency);
  all.add(targets.nodes);
  pack(all, targets.anchored);
  pack(all, level_part);
  pack(all, of_base);
  pack_options(all, options, true);
  return content_hash(all.bytes());
}

CalibrationStore::CalibrationStore(fs::path folder, Progress* progress)
    : folder_(std::move(folder)), progress_(progress) {
  try {
    write_text_file(folder_ / "about.txt", kAbout);
  } catch (const IoError& error) {
    throw IoError(
        fmt::format("calibration: its state cannot be saved in {}: {}; use a writable folder or "
                    "none",
                    folder_.string(), error.what()));
  }
}

std::optional<BaseMeasurements> CalibrationStore::measurements(
    std::size_t part, const std::string& fingerprint) const {
  const std::optional<std::string> payload = read(name_of_measurements(part), fingerprint);
  if (!payload) return std::nullopt;
  Unpacker from(*payload);
  BaseMeasurements measured;
  measured.squared_frequency = from.take_list<double>();
  const auto modes = from.take<std::uint64_t>();
  for (std::uint64_t mode = 0; mode < modes; ++mode)
    measured.modal_forces.push_back(from.take_vectors());
  const auto levels = from.take<std::uint64_t>();
  for (std::uint64_t level = 0; level < levels; ++level)
    measured.compliance.push_back(from.take_list<double>());
  measured.highest_frequency = from.take<double>();
  return measured;
}

void CalibrationStore::keep(std::size_t part, const std::string& fingerprint,
                            const BaseMeasurements& measured) const {
  Packer to;
  to.add(measured.squared_frequency);
  to.add(static_cast<std::uint64_t>(measured.modal_forces.size()));
  for (const std::vector<Vec3>& force : measured.modal_forces) to.add(force);
  to.add(static_cast<std::uint64_t>(measured.compliance.size()));
  for (const std::vector<double>& of_level : measured.compliance) to.add(of_level);
  to.add(measured.highest_frequency);
  write(name_of_measurements(part), fingerprint, to.bytes());
}

std::optional<FitState> CalibrationStore::fit(std::size_t level, std::size_t part,
                                              const std::string& fingerprint) const {
  const std::optional<std::string> payload = read(name_of_fit(level, part), fingerprint);
  if (!payload) return std::nullopt;
  Unpacker from(*payload);
  FitState state;
  visit_members(state, [&](auto& member) { take(from, member); });
  return state;
}

void CalibrationStore::keep(std::size_t level, std::size_t part, const std::string& fingerprint,
                            const FitState& state) const {
  Packer to;
  visit_members(state, [&](const auto& member) { pack(to, member); });
  write(name_of_fit(level, part), fingerprint, to.bytes());
}

fs::path CalibrationStore::place(const std::string& name) const {
  return folder_ / (name + ".bin");
}

std::optional<std::string> CalibrationStore::read(const std::string& name,
                                                  const std::string& fingerprint) const {
  std::error_code error;
  if (!fs::exists(place(name), error)) return std::nullopt;
  const auto refuse = [&](const char* why) {
    if (progress_ != nullptr)
      progress_->say(fmt::format("calibration: {} {} and is ignored", place(name).string(), why));
    return std::nullopt;
  };
  const std::string bytes = read_file(place(name));
  const std::size_t size = bytes.size() < kChecksumSize ? 0 : bytes.size() - kChecksumSize;
  const std::string_view body = std::string_view(bytes).substr(0, size);
  if (size == 0 || bytes.substr(size) != content_hash(body)) return refuse("is damaged");
  try {
    Unpacker from(body);
    if (from.take<std::uint32_t>() != kFormat)
      return refuse("has the format of another version of springlod");
    if (from.take_text() != fingerprint)
      return refuse("belongs to another base, another level or other options");
    return from.take_text();
  } catch (const IoError&) {
    return refuse("is damaged");
  }
}

void CalibrationStore::write(const std::string& name, const std::string& fingerprint,
                             const std::string& payload) const {
  Packer file;
  file.add(kFormat);
  file.add(std::string_view(fingerprint));
  file.add(std::string_view(payload));
  write_text_file(place(name), file.bytes() + content_hash(file.bytes()));
}

}  // namespace springlod::lod
