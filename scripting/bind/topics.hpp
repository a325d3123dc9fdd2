#pragma once

#include <memory>

#include "scripting/engine/api.hpp"

namespace springlod::scripting {

/// The whole scripting API.
std::unique_ptr<Api> make_api();

// One function for each file of this folder: registers the functions and types of its topic.
void describe_session(Api& api);
void describe_options_of(Api& api);
void describe_files(Api& api);
void describe_model(Api& api);
void describe_materials(Api& api);  // of model too, called by describe_model
void describe_assets(Api& api);     // likewise
void describe_elastic(Api& api);
void describe_voxelize(Api& api);
void describe_grid(Api& api);       // of voxelize too, called by describe_voxelize
void describe_bodies(Api& api);     // of voxelize too, called by describe_voxelize
void describe_random(Api& api);     // of voxelize too, called by describe_voxelize
void describe_refill(Api& api);     // likewise, called by describe_lod: it makes levels
void describe_calibrate(Api& api);  // likewise: certificates and what simplify calibrates by
void describe_lod(Api& api);
void describe_merge_log(Api& api);
void describe_sim(Api& api);
void describe_compare(Api& api);    // of sim too, called by describe_sim
void describe_deviation(Api& api);  // likewise
void describe_pick(Api& api);       // likewise
void describe_stability(Api& api);  // of sim too
void describe_render(Api& api);
void describe_report(Api& api);
void describe_export(Api& api);
void describe_view(Api& api);  // of report too, called by describe_report
void describe_statistics(Api& api);
void describe_sweep(Api& api);
void describe_sweep_running(Api& api);
void describe_sweep_results(Api& api);
void describe_sweep_submit(Api& api);

}  // namespace springlod::scripting
