#pragma once

#include <string>
#include <vector>

#include "report/export/export.hpp"

namespace springlod::report {

/// The surface as one OBJ object with its vertices at `points` [m], a group for each mesh part. One
/// object, because programs number the vertices of each object anew, and point caches count them
/// all.
std::string obj_text(const ExportedModel& body, const std::vector<Vec3>& points);

}  // namespace springlod::report
