#include "scripting/bind/topics.hpp"

#include "scripting/engine/script_error.hpp"

namespace springlod::scripting {

std::unique_ptr<Api> make_api() {
  auto api = std::make_unique<Api>();
  describe_session(*api);
  describe_options_of(*api);
  describe_files(*api);
  describe_voxelize(*api);
  describe_model(*api);
  describe_elastic(*api);
  describe_lod(*api);
  describe_merge_log(*api);
  describe_sim(*api);
  describe_render(*api);
  describe_report(*api);
  describe_export(*api);
  describe_statistics(*api);
  describe_sweep(*api);
  describe_sweep_running(*api);
  describe_sweep_results(*api);
  describe_sweep_submit(*api);
  describe_errors(*api);
  return api;
}

}  // namespace springlod::scripting
