// Calibrating the levels of a chain, and certifying what came of it.

#include <string>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "lod/quality/certify.hpp"
#include "scripting/bind/calibration_option.hpp"
#include "scripting/bind/node_choice.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/bind/values.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

namespace {

lod::TargetRegion read_region(Call& call, int table, const std::string& owner,
                              const MassSpringModel& base) {
  lod::TargetRegion region;
  TableReader reader = call.record(table, "Region", owner);
  region.nodes = read_nodes(reader, "nodes", base);
  if (region.nodes.empty())
    reader.refuse("nodes", "given: a list of node numbers or a function of a node");
  reader.read("weight", region.weight);
  reader.read("patches", region.patches);
  reader.finish();
  return region;
}

std::vector<lod::TargetRegion> read_regions(Call& call, TableReader& reader,
                                            const MassSpringModel& base) {
  std::vector<lod::TargetRegion> regions;
  const int list = reader.raw("regions");
  if (list == 0) return regions;
  lua_State* L = call.lua();
  if (!lua_istable(L, list)) reader.refuse("regions", "a list of Region tables");
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, list)); ++i) {
    lua_rawgeti(L, list, i);
    regions.push_back(
        read_region(call, lua_gettop(L), fmt::format("{}: regions[{}]", reader.owner(), i), base));
    lua_settop(L, list);  // reading a region leaves what it read on the stack
  }
  return regions;
}

int certify_binding(Call& call) {
  const auto asset = std::make_shared<LodAsset>(*call.value<LodAsset>(1));
  lod::CertifyOptions options;
  options.threads = call.session().settings().threads;
  options.progress = call.progress();
  TableReader reader = call.options(2);
  reader.read("modes", options.modes);
  reader.read("held_out_loads", options.held_out_loads);
  reader.read("seed", options.seed);
  reader.read("tolerance", options.tolerance);
  options.within = read_nodes(reader, "within", asset->chain.levels.front().model);
  options.anchored = read_anchored(reader, asset->chain.levels.front().model);
  reader.finish();
  lod::certify(asset->chain, options);
  return call.give(std::shared_ptr<const LodAsset>(asset));
}

void describe_regions(Api& api) {
  const lod::TargetRegion usual;
  api.add(RecordEntry{
      .name = "Region",
      .summary = "Where a calibrated level shall give way as the base does: a contact patch, the "
                 "neighbourhood of an anchored end.",
      .fields = {{.name = "nodes",
                  .type = "list of integers or function",
                  .help = "of the base: their numbers, or a function of a Node that returns true "
                          "for them; those on the border that are not anchored count"},
                 {.name = "weight",
                  .type = "number",
                  .fallback = fmt::format("{}", usual.weight),
                  .help = "of each load on it, where a smooth load has 1"},
                 {.name = "patches",
                  .type = "integer",
                  .fallback = fmt::format("{}", usual.patches),
                  .help = "loads on patches within it: half of them pairs that are pulled apart, "
                          "if there is room, the others pushed against the body's inertia"}},
      .example = "regions = {{nodes = function(node) return node.z < 0.02 end, weight = 2}}"});
}

void describe_record(Api& api) {
  const lod::CalibrateOptions calibrate;
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
            .fallback = "150, down to 60 for a base of more than 2000 nodes",
            .help = "pairs of patches of the surface that are pulled apart, besides the nine "
                    "smooth loads"},
           {.name = "patch_weight",
            .type = "number",
            .fallback = fmt::format("{}", calibrate.targets.patch_weight),
            .help = "of each of them, where a smooth load has 1"},
           {.name = "regions",
            .type = "list of Region",
            .fallback = "none",
            .help = "parts of the surface that matter, with loads of their own"},
           {.name = "mode_weight",
            .type = "number",
            .fallback = fmt::format("{}", calibrate.targets.mode_weight),
            .help = "how much modes count, over what they usually do"},
           {.name = "load_weight",
            .type = "number",
            .fallback = fmt::format("{}", calibrate.targets.load_weight),
            .help = "how much static loads of every kind count, over what they usually do"},
           {.name = "seed",
            .type = "integer",
            .fallback = fmt::format("{}", calibrate.targets.seed),
            .help = "of the patches"},
           {.name = "tolerance",
            .type = "number",
            .fallback = "0.002 sqrt(N0 / N)",
            .help = "mean error of the ten lowest frequencies that is good enough; other modes may "
                    "miss by four times as much, smooth loads and regions by eight, patches by "
                    "twenty"},
           {.name = "iterations",
            .type = "integer",
            .fallback = "90",
            .help = "steps at most; by itself fewer for levels of more than 500 nodes, down to 10"},
           {.name = "least_frequency",
            .type = "number",
            .fallback = fmt::format("{}", calibrate.fit.least_frequency),
            .help =
                "where the largest frequency, which bounds the step, need not fall any further, "
                "over that of a lattice of as many nodes"},
           {.name = "moments",
            .type = "one of",
            .fallback = "\"body\"",
            .help = "masses shift between nodes; mass, centre and second moments stay those of the "
                    "whole body, or of each of its \"pieces\" of one material too: truer where "
                    "things collide, of a shorter step",
            .choices = {"body", "pieces"}},
           anchored_parameter(),
           {.name = "store",
            .type = "string",
            .fallback = "none",
            .help = "folder that keeps what was found so far: a call that was stopped, or killed, "
                    "goes on from there when it is made again, to the same bits; what is of "
                    "another base, level or options is not used"},
           {.name = "keep_every",
            .type = "quantity",
            .dimension = Dimension::time,
            .fallback = fmt::format("{} s", calibrate.keep_every),
            .help = "time between two writes of a fit's state to the store, 0: after each step; "
                    "a calibration that is killed loses so much, one that is stopped with Ctrl-C "
                    "nothing"}},
      .example = "calibration = {targets = \"modes\", tolerance = 0.01}"});
}

void describe_certify(Api& api) {
  const lod::CertifyOptions certify;
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
                  {.name = "within",
                   .type = "list of integers or function",
                   .fallback = "anywhere",
                   .help = "nodes of the base whose surface the held-out loads act on, such as a "
                           "region that calibration was told of"},
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
                      lod::SimplifyOptions& options) {
  options.calibrate.threads = call.session().settings().threads;
  reader.choose("calibrate", options.calibration,
                {{"none", lod::Calibration::none},
                 {"moduli", lod::Calibration::moduli},
                 {"modes", lod::Calibration::modes}});
  const int table = reader.raw("calibration");
  if (table == 0) return;
  TableReader record = call.record(table, "Calibration", "simplify: calibration");
  lod::TargetOptions& targets = options.calibrate.targets;
  lod::FitOptions& fit = options.calibrate.fit;
  enum class Kinds { both, modes, loads };
  Kinds kinds = Kinds::both;
  record.choose("targets", kinds,
                {{"both", Kinds::both}, {"modes", Kinds::modes}, {"loads", Kinds::loads}});
  record.read("modes", targets.modes);
  if (record.has("patches")) record.read("patches", targets.patches.emplace());
  record.read("patch_weight", targets.patch_weight);
  targets.regions = read_regions(call, record, base);
  record.read("mode_weight", targets.mode_weight);
  record.read("load_weight", targets.load_weight);
  record.read("seed", targets.seed);
  record.read("tolerance", fit.tolerance);
  record.read("iterations", fit.iterations);
  record.read("least_frequency", fit.least_frequency);
  record.choose("moments", fit.moments,
                {{"body", lod::KeptMoments::body}, {"pieces", lod::KeptMoments::pieces}});
  targets.anchored = read_anchored(record, base);
  std::string store;
  record.read("store", store);
  options.calibrate.store = store;
  record.read("keep_every", options.calibrate.keep_every);
  record.finish();
  if (kinds == Kinds::loads) targets.modes = 0;
  if (kinds == Kinds::modes) {
    targets.smooth_loads = false;
    targets.patches = 0;
    if (!targets.regions.empty())
      record.refuse("regions", "left out beside targets = \"modes\": they are regions of loads");
  }
}

void describe_calibrate(Api& api) {
  describe_regions(api);
  describe_record(api);
  describe_certify(api);
}

}  // namespace springlod::scripting
