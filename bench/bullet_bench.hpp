#pragma once

#include "bench/subjects.hpp"

namespace springlod::bench {

/// Registers benchmarks of Bullet's soft bodies with the same nodes and springs, under "bullet/".
void register_bullet(Subjects& subjects);

}  // namespace springlod::bench
