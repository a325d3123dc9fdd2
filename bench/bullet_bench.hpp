#pragma once

#include "bench/subjects.hpp"

namespace springlod::bench {

/// Registers Bullet's soft bodies, with the nodes and springs of ours, under "bullet/".
void register_bullet(Subjects& subjects);

}  // namespace springlod::bench
