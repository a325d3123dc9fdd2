// Calibration and certification of the levels of a chain.

#include <string>

#include "lod/options.hpp"
#include "lod/quality/certify.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

namespace {

int certify_binding(Call& call) {
  const auto asset = std::make_shared<ChainValue>(LodAsset(*call.value<ChainValue>(1)));
  lod::CertifyOptions options;
  options.threads = call.session().settings().threads;
  options.progress = call.progress();
  TableReader reader = call.options(2);
  read_options(call, reader, options, &asset->chain.levels.front().model);
  reader.finish();
  lod::certify(asset->chain, options);
  return call.give(std::shared_ptr<const ChainValue>(asset));
}

void describe_regions(Api& api) {
  api.add(RecordEntry{
      .name = "Region",
      .summary = "Nodes where calibration fits the local compliance to the base's, such as a "
                 "contact patch or the neighbourhood of an anchored end.",
      .fields = parameters_of<lod::TargetRegion>(),
      .example = "regions = {{nodes = function(node) return node.z < 0.02 end, weight = 2}}"});
}

void describe_record(Api& api) {
  api.add(RecordEntry{.name = "Calibration",
                      .summary = "Targets of simplify with calibrate = \"modes\".",
                      .fields = parameters_of<lod::CalibrateOptions>(),
                      .example = "calibration = {targets = \"modes\", tolerance = 0.01}"});
}

void describe_certify(Api& api) {
  api.add(FunctionEntry{
      .name = "certify",
      .group = "Levels of detail",
      .summary = "Compares every level with the base: moduli, frequencies, loads, masses, step and "
                 "cost. s.info returns the certificates and s.save stores them.",
      .arguments = {{.name = "chain", .type = "LodChain", .help = "levels and their base"}},
      .options = parameters_of<lod::CertifyOptions>(),
      .returns = "LodChain with a certificate for each level",
      .errors = "Hundreds of mechanisms in a large component.",
      .example = "local chain = s.certify(s.simplify(base))\n"
                 "print(s.info(chain).levels[2].certificate.f1_10_error)",
      .call = certify_binding});
}

}  // namespace

void describe_calibrate(Api& api) {
  describe_regions(api);
  describe_record(api);
  describe_certify(api);
}

}  // namespace springlod::scripting
