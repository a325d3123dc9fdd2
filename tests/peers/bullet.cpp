// peer_bullet FOLDER: hangs the levels that hang_jobs.lua wrote in Bullet, from their headers,
// which are compiled in, and checks their elongations.

#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <numeric>
#include <string>
#include <vector>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "level_0.hpp"
#include "level_1.hpp"
#include "level_2.hpp"

namespace {

using Json = nlohmann::json;

int failures = 0;

void check(bool passed, const std::string& text) {
  std::cout << (passed ? "ok     " : "FAILED ") << text << '\n';
  if (!passed) ++failures;
}

/// A level of the test: what its header gives.
struct Level {
  btSoftBody* (*make)(btSoftBodyWorldInfo&, const std::vector<std::uint32_t>&, const btVector3&,
                      btScalar);
  btVector3 center;
  btScalar step;
};

const Level kLevels[] = {
    {level_0::make_soft_body,
     {level_0::kCenter[0], level_0::kCenter[1], level_0::kCenter[2]},
     level_0::kStep},
    {level_1::make_soft_body,
     {level_1::kCenter[0], level_1::kCenter[1], level_1::kCenter[2]},
     level_1::kStep},
    {level_2::make_soft_body,
     {level_2::kCenter[0], level_2::kCenter[1], level_2::kCenter[2]},
     level_2::kStep},
};

// With y up, as in the headers.
btVector3 y_up(const Json& v) {
  return {v[0].get<btScalar>(), v[2].get<btScalar>(), -v[1].get<btScalar>()};
}

struct World {
  btSoftBodyRigidBodyCollisionConfiguration collisions;
  btCollisionDispatcher dispatcher{&collisions};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &collisions};
};

double mean_along(const btSoftBody& body, const Json& nodes, const btVector3& direction) {
  double total = 0;
  for (const Json& node : nodes)
    total += static_cast<double>(body.m_nodes[node.get<int>()].m_x.dot(direction));
  return total / static_cast<double>(nodes.size());
}

/// Elongation after vibrations have died out, as the mean over the last part.
double hang(const Level& level, const Json& job, btScalar step, int iterations) {
  World stage;
  const btVector3 gravity = y_up(job["gravity"]);
  stage.world.setGravity(gravity);
  stage.world.getWorldInfo().m_gravity = gravity;
  btSoftBody* body = level.make(stage.world.getWorldInfo(),
                                job["held"].get<std::vector<std::uint32_t>>(), level.center, step);
  body->m_cfg.piterations = iterations;
  body->setActivationState(DISABLE_DEACTIVATION);
  const double frequency =
      std::sqrt(static_cast<double>(gravity.length()) / job["elongation"].get<double>());
  body->m_cfg.kDP = static_cast<btScalar>(2 * frequency) * step;  // of the velocity per step
  stage.world.addSoftBody(body);
  const btVector3 direction = gravity.normalized();
  const double start = mean_along(*body, job["free"], direction);
  const int steps = static_cast<int>(16 / frequency / static_cast<double>(step));
  double total = 0;
  int count = 0;
  for (int i = 0; i < steps; ++i) {
    stage.world.stepSimulation(step, 0);
    if (i < steps * 6 / 10) continue;
    total += mean_along(*body, job["free"], direction) - start;
    ++count;
  }
  stage.world.removeSoftBody(body);
  delete body;
  return total / count;
}

void check_arrays(const Json& job, const Level& level, const Json& model) {
  World stage;
  btSoftBody* body = level.make(stage.world.getWorldInfo(), {}, level.center, level.step);
  const auto masses = model["nodes"]["mass"].get<std::vector<double>>();
  const double mass = std::accumulate(masses.begin(), masses.end(), 0.0);
  double off = 0;
  for (int n = 0; n < body->m_nodes.size(); ++n) {
    Json at = Json::array();
    for (std::size_t axis = 0; axis < 3; ++axis)
      at.push_back(model["nodes"]["rest"][3 * static_cast<std::size_t>(n) + axis]);
    off = std::max(off, static_cast<double>((body->m_nodes[n].m_x - y_up(at)).length()));
  }
  check(std::abs(static_cast<double>(body->getTotalMass()) / mass - 1) < 1e-5 && off < 1e-6,
        fmt::format("level {}: mass, and places within {:.1e} m", job["level"].dump(), off));
  double worst = body->m_links.size() == static_cast<int>(model["springs"]["a"].size()) ? 0 : 1;
  for (int s = 0; s < body->m_links.size(); ++s) {
    // c0 = mobility / 2 + 1 / (k dt^2), if that is above mobility
    const btSoftBody::Link& link = body->m_links[s];
    const auto mobility = static_cast<double>(link.m_n[0]->m_im + link.m_n[1]->m_im);
    const auto step = static_cast<double>(level.step);
    const double stiffness =
        model["springs"]["stiffness"][static_cast<std::size_t>(s)].get<double>();
    const double expected = std::max(mobility, mobility / 2 + 1 / (stiffness * step * step));
    worst = std::max(worst, std::abs(static_cast<double>(link.m_c0) / expected - 1));
  }
  check(worst < 1e-5, fmt::format("level {}: links within {:.1e}", job["level"].dump(), worst));
  delete body;
}

Json read(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: peer_bullet FOLDER\n";
    return 2;
  }
  const std::string folder = argv[1];
  for (const Json& job : read(folder + "/jobs.json")) {
    const auto number = job["level"].get<std::size_t>();
    const Level& level = kLevels[number];
    check_arrays(job, level, read(fmt::format("{}/json/level_{}.json", folder, number)));
    const auto error = [&](btScalar step, int iterations) {
      return hang(level, job, step, iterations) / job["elongation"].get<double>() - 1;
    };
    const double at_step = error(level.step, 1);
    check(std::abs(at_step) < 0.02,
          fmt::format("level {}: elongation, error {:.2f} %", number, 100 * at_step));
    const double large = error(8 * level.step, 1);
    check(large > 0.05,
          fmt::format("level {}: {:.1f} % with eight times the step, links made for it", number,
                      100 * large));
    // Each iteration corrects the links again, as if they were stiffer.
    const double stiff = error(level.step, 4);
    check(stiff < -0.05,
          fmt::format("level {}: {:.1f} % with four iterations", number, 100 * stiff));
  }
  return failures > 0 ? 1 : 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
