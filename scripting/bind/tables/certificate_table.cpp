#include "scripting/bind/tables/certificate_table.hpp"

#include <algorithm>

#include <lua.hpp>

#include "lod/quality/grade.hpp"
#include "scripting/engine/result_table.hpp"

namespace springlod::scripting {
namespace {

template <class Entry, class Fill>
void set_list(lua_State* L, const char* name, const std::vector<Entry>& entries, const Fill& fill) {
  push_tables(L, entries, fill);
  end_field(L, name);
}

void set_lists(lua_State* L, const Certificate& certificate) {
  set_list(L, "moduli", certificate.moduli, [L](const Certificate::Moduli& m) {
    set_field(L, "material", m.material);
    set_field(L, "young", m.young);
    set_field(L, "base_young", m.base_young);
    set_field(L, "poisson", m.poisson);
    set_field(L, "base_poisson", m.base_poisson);
  });
  set_list(L, "frequencies", certificate.frequencies, [L](const Certificate::Frequency& f) {
    set_field(L, "level", f.level);
    set_field(L, "base", f.base);
    set_field(L, "error", f.level / f.base - 1);
    set_field(L, "mac", f.mac);
    set_field(L, "decay", f.decay);
    set_field(L, "base_decay", f.base_decay);
  });
  set_list(L, "loads", certificate.loads, [L](const Certificate::Load& load) {
    set_field(L, "name", load.name);
    set_field(L, "held_out", load.held_out);
    set_field(L, "error", load.error);
  });
  set_field(L, "misses", certificate.unmet);
}

void set_optional(lua_State* L, const char* name, const std::optional<double>& number) {
  if (number) set_field(L, name, *number);
}

/// Processor time of a simulated second on the reference machine, by the kernel that runs the model
/// in double precision.
void set_run_time(lua_State* L, const Level& level, const sim::StepTime& base_time) {
  const Certificate& certificate = *level.certificate;
  const sim::StepTime time = sim::step_time(level.model, sim::Precision::double_precision);
  set_field(L, "kernel", to_string(time.kernel));
  set_field(L, "base_kernel", to_string(base_time.kernel));
  if (!(certificate.stable_step > 0 && certificate.base_stable_step > 0)) return;
  const double seconds = time.seconds / certificate.stable_step;
  const double base_seconds = base_time.seconds / certificate.base_stable_step;
  set_field(L, "seconds", seconds);
  set_field(L, "base_seconds", base_seconds);
  if (base_seconds > 0) set_field(L, "seconds_ratio", seconds / base_seconds);
}

void set_means(lua_State* L, const Certificate& certificate) {
  const std::size_t count = certificate.frequencies.size();
  if (count > 0) set_field(L, "f1_10_error", mean_frequency_error(certificate, 0, 10));
  if (count > 10) set_field(L, "f11_20_error", mean_frequency_error(certificate, 10, 20));
  for (const bool held_out : {false, true})
    if (std::any_of(certificate.loads.begin(), certificate.loads.end(),
                    [&](const Certificate::Load& load) { return load.held_out == held_out; }))
      set_field(L, held_out ? "held_out_load_error" : "fitted_load_error",
                mean_load_error(certificate, held_out));
}

}  // namespace

void push_certificate(lua_State* L, const Level& level, const sim::StepTime& base_time) {
  const Certificate& certificate = *level.certificate;
  begin_table(L);
  set_field(L, "grade", to_string(lod::grade(certificate)));
  set_field(L, "summary", lod::grade_text(certificate));
  set_lists(L, certificate);
  set_means(L, certificate);
  set_optional(L, "mac", mean_mac(certificate));
  set_optional(L, "decay_error", mean_decay_error(certificate));
  set_optional(L, "blow_error", certificate.blow_error);
  set_optional(L, "first_period_error", certificate.first_period_error);
  set_optional(L, "contact_ratio", certificate.contact_ratio);
  set_field(L, "mass_error", certificate.mass_error);
  set_field(L, "center_shift", certificate.center_shift);
  set_field(L, "second_moment_error", certificate.second_moment_error);
  set_field(L, "highest_frequency", certificate.highest_frequency);
  set_field(L, "base_highest_frequency", certificate.base_highest_frequency);
  set_field(L, "stable_step", certificate.stable_step);
  set_field(L, "base_stable_step", certificate.base_stable_step);
  set_field(L, "cost", certificate.cost);
  set_field(L, "base_cost", certificate.base_cost);
  if (certificate.base_cost > 0)
    set_field(L, "cost_ratio", certificate.cost / certificate.base_cost);
  set_run_time(L, level, base_time);
  set_field(L, "zero_modes", certificate.zero_modes);
  set_field(L, "expected_zero_modes", certificate.expected_zero_modes);
  if (certificate.tolerance > 0) set_field(L, "tolerance", certificate.tolerance);
}

void describe_certificate(Api& api) {
  api.add(RecordEntry{
      .name = "Certificate",
      .summary = "Measurements of a level compared with its base: s.info(chain).levels[i]"
                 ".certificate. Errors are level / base - 1.",
      .fields =
          {result_field("grade", "string",
                        "\"good\", \"fair\", \"rough\" or \"faulty\": that of the worst "
                        "quantity; see s.choices.grade"),
           result_field("summary", "string", "the grade and its reasons in one line"),
           result_field("moduli", "list of tables",
                        "material, young and base_young [Pa], poisson and base_poisson"),
           result_field("frequencies", "list of tables",
                        "lowest frequencies: level and base [Hz], error, mac (modal "
                        "assurance criterion, 0..1), decay and base_decay (rates at which "
                        "damping makes the amplitude fall [1/s])"),
           result_field("loads", "list of tables",
                        "static loads: name, held_out (true: calibration is not fitted to "
                        "it), error of the compliance (against the work of the load along "
                        "the means of the base's displacement over the groups of nodes)"),
           result_field("f1_10_error", "number", "mean |error| of the ten lowest frequencies"),
           result_field("f11_20_error", "number",
                        "mean |error| of the next ten; nil if there are none"),
           result_field("fitted_load_error", "number",
                        "mean |error| of the fitted loads; nil if there are none"),
           result_field("held_out_load_error", "number",
                        "mean |error| of the held-out loads; nil if there are none"),
           result_field("mac", "number", "mean MAC of the ten lowest modes"),
           result_field("decay_error", "number",
                        "mean |error| of the decay rates of these; nil without damping"),
           result_field("blow_error", "number",
                        "error of the velocities right after impacts that give the base the "
                        "velocities of its ten lowest modes; nil in old assets"),
           result_field("first_period_error", "number",
                        "error of the displacements in the first period of free vibration "
                        "that starts with these velocities; nil in old assets"),
           result_field("contact_ratio", "number",
                        "largest contact area over mass of a node, over that of the base; "
                        "nil without contact area and in old assets"),
           result_field("mass_error", "number", "error of the mass"),
           result_field("center_shift", "number",
                        "displacement of the centre of mass / radius of gyration"),
           result_field("second_moment_error", "number",
                        "largest error of the tensor's entries / its largest entry"),
           result_field("highest_frequency", "number",
                        "omega_max [rad/s]; base_highest_frequency: that of the base"),
           result_field("stable_step", "number",
                        "stable step of explicit schemes [s]; base_stable_step: that of the base"),
           result_field("cost", "number",
                        "number of springs / stable step [1/s]; base_cost: that of the base"),
           result_field("cost_ratio", "number", "cost / base_cost"),
           result_field("kernel", "string",
                        "\"rows\" or \"quads\": the kernel of symplectic_euler that runs the "
                        "level; base_kernel: that of the base"),
           result_field("seconds", "number",
                        "estimated processor time of a simulated second in free flight, in "
                        "double precision, on the machine of docs/speed.md [s]; "
                        "base_seconds: that of the base"),
           result_field("seconds_ratio", "number", "seconds / base_seconds"),
           result_field("zero_modes", "integer", "number of zero modes"),
           result_field("expected_zero_modes", "integer", "expected number of zero modes"),
           result_field("tolerance", "number", "requested tolerance of f1_10_error; nil if none"),
           result_field("misses", "list of strings",
                        "what exceeds the requested tolerance; empty if nothing does")},
      .example = "s.info(chain).levels[2].certificate.f1_10_error"});
}

}  // namespace springlod::scripting
