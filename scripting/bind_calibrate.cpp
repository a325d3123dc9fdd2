// Calibrating the levels of a chain, and certifying what came of it.

#include <utility>

#include <fmt/format.h>

#include "lod/certify.hpp"
#include "scripting/calibration_option.hpp"
#include "scripting/call.hpp"
#include "scripting/node_choice.hpp"
#include "scripting/values.hpp"

namespace springlod {

namespace {

int certify_binding(Call& call) {
  const auto asset = std::make_shared<LodAsset>(*call.value<LodAsset>(1));
  CertifyOptions options;
  options.threads = call.session().settings().threads;
  options.progress = call.progress();
  TableReader reader = call.options(2);
  reader.read("modes", options.modes);
  reader.read("held_out_loads", options.held_out_loads);
  reader.read("seed", options.seed);
  reader.read("tolerance", options.tolerance);
  options.anchored = read_anchored(reader, asset->chain.levels.front().model);
  reader.finish();
  certify(asset->chain, options);
  return call.give(std::shared_ptr<const LodAsset>(asset));
}

void describe_record(Api& api) {
  const CalibrateOptions calibrate;
  api.add(RecordEntry{
      .name = "Calibration",
      .summary = "What simplify with calibrate = \"modes\" aims at.",
      .fields =
          {{.name = "targets",
            .type = "one of",
            .fallback = "\"both\"",
            .help = "what shall be as in the base: the lowest modes, static loads, or both",
            .choices = {"both", "modes", "loads"}},
           {.name = "modes",
            .type = "integer",
            .fallback = fmt::format("{}", calibrate.targets.modes),
            .help = "how many of the lowest frequencies"},
           {.name = "patches",
            .type = "integer",
            .fallback = fmt::format("{}", calibrate.targets.patches),
            .help = "pairs of patches of the surface that are pulled apart, besides the nine "
                    "smooth loads"},
           {.name = "patch_weight",
            .type = "number",
            .fallback = fmt::format("{}", calibrate.targets.patch_weight),
            .help = "of each of them, where a smooth load has 1"},
           {.name = "seed",
            .type = "integer",
            .fallback = fmt::format("{}", calibrate.targets.seed),
            .help = "of the patches"},
           {.name = "tolerance",
            .type = "number",
            .fallback = "0.002 sqrt(N0 / N)",
            .help = "mean error of the ten lowest frequencies that is good enough; other modes may "
                    "miss by four times as much, smooth loads by eight, patches by twenty"},
           {.name = "iterations",
            .type = "integer",
            .fallback = fmt::format("{}", calibrate.fit.iterations),
            .help = "at most"},
           {.name = "least_frequency",
            .type = "number",
            .fallback = fmt::format("{}", calibrate.fit.least_frequency),
            .help =
                "where the largest frequency, which bounds the step, need not fall any further, "
                "over that of a lattice of as many nodes"},
           anchored_parameter()},
      .example = "calibration = {targets = \"modes\", tolerance = 0.01}"});
}

void describe_certify(Api& api) {
  const CertifyOptions certify;
  api.add(FunctionEntry{
      .name = "certify",
      .group = "Levels of detail",
      .summary = "Measures every level beside the base: moduli, frequencies, loads, masses, step "
                 "and cost. s.info tells, and s.save keeps, what was found.",
      .arguments = {{.name = "chain", .type = "LodChain", .help = "levels and their base"}},
      .options = {{.name = "modes",
                   .type = "integer",
                   .fallback = fmt::format("{}", certify.modes),
                   .help = "lowest frequencies to compare"},
                  {.name = "held_out_loads",
                   .type = "integer",
                   .fallback = fmt::format("{}", certify.held_out_loads),
                   .help = "pinches, and as many pushes, on patches of the surface; calibration is "
                           "fitted to neither"},
                  {.name = "seed",
                   .type = "integer",
                   .fallback = fmt::format("{}", certify.seed),
                   .help = "of where they act"},
                  {.name = "tolerance",
                   .type = "number",
                   .fallback = "0.002 sqrt(N0 / N)",
                   .help =
                       "mean error of the ten lowest frequencies that a level may have; a level "
                       "that misses it says so"},
                  anchored_parameter()},
      .returns = "LodChain with a certificate for each level",
      .errors = "Hundreds of loose nodes in a large part; anchors that leave free what a load "
                "moves.",
      .example = "local chain = s.certify(s.simplify(base))\n"
                 "print(s.info(chain).levels[2].certificate.f1_10_error)",
      .call = certify_binding});
}

}  // namespace

void read_calibration(Call& call, TableReader& reader, const MassSpringModel& base,
                      SimplifyOptions& options) {
  options.calibrate.threads = call.session().settings().threads;
  reader.choose("calibrate", options.calibration,
                {{"none", Calibration::none},
                 {"moduli", Calibration::moduli},
                 {"modes", Calibration::modes}});
  const int table = reader.raw("calibration");
  if (table == 0) return;
  TableReader record = call.record(table, "Calibration", "simplify: calibration");
  TargetOptions& targets = options.calibrate.targets;
  FitOptions& fit = options.calibrate.fit;
  enum class Kinds { both, modes, loads };
  Kinds kinds = Kinds::both;
  record.choose("targets", kinds,
                {{"both", Kinds::both}, {"modes", Kinds::modes}, {"loads", Kinds::loads}});
  record.read("modes", targets.modes);
  record.read("patches", targets.patches);
  record.read("patch_weight", targets.patch_weight);
  record.read("seed", targets.seed);
  record.read("tolerance", fit.tolerance);
  record.read("iterations", fit.iterations);
  record.read("least_frequency", fit.least_frequency);
  targets.anchored = read_anchored(record, base);
  record.finish();
  if (kinds == Kinds::loads) targets.modes = 0;
  if (kinds == Kinds::modes) {
    targets.smooth_loads = false;
    targets.patches = 0;
  }
}

void describe_calibrate(Api& api) {
  describe_record(api);
  describe_certify(api);
}

}  // namespace springlod
