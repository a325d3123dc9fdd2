#pragma once

#include <vector>

#include "render/scene.hpp"
#include "report/animate.hpp"
#include "report/filmed_run.hpp"

namespace springlod::report {

/// Whether bodies of these sizes differ so much that one scale would leave most of some panels
/// empty. `sizes`: of the bodies at rest [m].
bool differ_in_size(const std::vector<double>& sizes);

/// The cameras of each run, one for each of `times` [s]. What they show lies between the labels. A
/// fixed camera sees the whole motion of
/// all runs; if the bodies differ in size, that of each run sees its own. All look from one
/// direction.
std::vector<std::vector<render::Camera>> film_cameras(const std::vector<FilmedRun>& runs,
                                                      const std::vector<double>& times,
                                                      const AnimateOptions& options);

}  // namespace springlod::report
