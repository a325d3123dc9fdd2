#include "bench/bullet_bench.hpp"

#include <memory>
#include <numeric>

// Bullet's headers cause warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#pragma GCC diagnostic pop
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/counters.hpp"

namespace springlod::bench {
namespace {

// Lengths in Bullet [m], whose defaults suit metres, for cells of 1 cm.
constexpr btScalar kMargin = 0.001F;
constexpr btScalar kDistanceCell = 0.05F;  // cell of its signed distance grid

// Steps before timing starts.
constexpr int kFirstSteps = 10;

btVector3 to_bullet(const Vec3& v) {
  return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

/// The common parts of both worlds, and a floor just below the body; contact starts within the
/// collision margin.
struct Stage {
  btSoftBodyRigidBodyCollisionConfiguration collisions;
  btCollisionDispatcher dispatcher{&collisions};
  btDbvtBroadphase broadphase;
  btBoxShape floor_shape{{10, 10, 1}};
  btRigidBody floor{{0, nullptr, &floor_shape}};

  explicit Stage(const MassSpringModel& model) {
    constexpr btScalar kHalfHeight = 1;
    const auto lowest = static_cast<btScalar>(bounds(model.rest).min().z());
    floor_shape.setMargin(kMargin);
    floor.setWorldTransform(
        btTransform(btQuaternion::getIdentity(), {0, 0, lowest - kMargin / 2 - kHalfHeight}));
    floor.setInterpolationWorldTransform(floor.getWorldTransform());
    floor.setFriction(1);  // multiplied by that of the body
  }
};

/// A soft body with the model's nodes, masses and springs.
std::unique_ptr<btSoftBody> soft_body(const MassSpringModel& model, const sim::Scenario& scenario,
                                      btSoftBodyWorldInfo& world) {
  world.m_gravity = to_bullet(scenario.gravity);
  world.m_sparsesdf.setDefaultVoxelsz(kDistanceCell);
  world.m_sparsesdf.Reset();
  std::vector<btVector3> x;
  for (const Vec3& node : model.rest) x.push_back(to_bullet(node));
  const std::vector<btScalar> mass(model.mass.begin(), model.mass.end());
  auto body =
      std::make_unique<btSoftBody>(&world, static_cast<int>(x.size()), x.data(), mass.data());
  for (std::size_t s = 0; s < model.spring_count(); ++s)
    body->appendLink(static_cast<int>(model.a[s]), static_cast<int>(model.b[s]));
  body->getCollisionShape()->setMargin(kMargin);
  body->m_cfg.kDF = static_cast<btScalar>(scenario.obstacles.front().friction);
  body->setActivationState(DISABLE_DEACTIVATION);
  return body;
}

/// Order of links in the position-based solver: the order of our springs, or an order by Bullet
/// with fewer dependencies between consecutive links.
struct Sweeps {
  int iterations = 1;
  bool reordered = false;
};

/// Bullet's position-based solver: a step corrects contacts and links `iterations` times.
class PositionBased {
 public:
  PositionBased(const MassSpringModel& model, const Sweeps& sweeps)
      : stage_(model),
        world_(&stage_.dispatcher, &stage_.broadphase, &solver_, &stage_.collisions) {
    const sim::Scenario scenario = rest_on_floor();
    world_.setGravity(to_bullet(scenario.gravity));
    world_.addRigidBody(&stage_.floor);
    world_.getWorldInfo().m_dispatcher = &stage_.dispatcher;
    world_.getWorldInfo().m_broadphase = &stage_.broadphase;
    body_ = soft_body(model, scenario, world_.getWorldInfo());
    if (sweeps.reordered) btSoftBodyHelpers::ReoptimizeLinkOrder(body_.get());
    body_->m_cfg.piterations = sweeps.iterations;
    constexpr btScalar kDamping = 0.1F;  // of the velocity per step, so that the body comes to rest
    body_->m_cfg.kDP = kDamping;
    world_.addSoftBody(body_.get());
  }
  ~PositionBased() {
    world_.removeSoftBody(body_.get());
    world_.removeRigidBody(&stage_.floor);
  }
  PositionBased(const PositionBased&) = delete;
  PositionBased& operator=(const PositionBased&) = delete;

  void step(double seconds) { world_.stepSimulation(static_cast<btScalar>(seconds), 0); }
  int contacts() const { return body_->m_rcontacts.size(); }

 private:
  Stage stage_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_;
  std::unique_ptr<btSoftBody> body_;
};

/// Bullet's deformable world with explicit integration of mass-spring forces. All springs have
/// equal stiffness and damping there: the means of the model.
class Explicit {
 public:
  Explicit(const MassSpringModel& model, bool damped)
      : stage_(model),
        world_(&stage_.dispatcher, &stage_.broadphase, &solver_, &stage_.collisions, &bodies_),
        springs_(mean(model.stiffness), damped ? mean(model.damping) : 0),
        gravity_(to_bullet(rest_on_floor().gravity)) {
    const sim::Scenario scenario = rest_on_floor();
    solver_.setDeformableSolver(&bodies_);
    world_.setImplicit(false);
    world_.setUseProjection(true);  // the faster of its two contact methods
    world_.setGravity(to_bullet(scenario.gravity));
    world_.addRigidBody(&stage_.floor);
    body_ = soft_body(model, scenario, world_.getWorldInfo());
    body_->m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN;
    body_->setSelfCollision(false);
    world_.addSoftBody(body_.get());
    world_.addForce(body_.get(), &springs_);
    world_.addForce(body_.get(), &gravity_);
  }
  ~Explicit() {
    world_.removeSoftBody(body_.get());
    world_.removeRigidBody(&stage_.floor);
  }
  Explicit(const Explicit&) = delete;
  Explicit& operator=(const Explicit&) = delete;

  void step(double seconds) { world_.stepSimulation(static_cast<btScalar>(seconds), 0); }
  int contacts() const { return body_->m_nodeRigidContacts.size(); }

 private:
  static btScalar mean(const std::vector<double>& values) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return static_cast<btScalar>(sum / static_cast<double>(values.size()));
  }

  Stage stage_;
  btDeformableBodySolver bodies_;
  btDeformableMultiBodyConstraintSolver solver_;
  btDeformableMultiBodyDynamicsWorld world_;
  btDeformableMassSpringForce springs_;
  btDeformableGravityForce gravity_;
  std::unique_ptr<btSoftBody> body_;
};

/// Creates the world once for all repetitions: its first step builds trees and takes seconds.
template <class World>
auto stepper(auto option) {
  return [option, world = std::shared_ptr<World>()](benchmark::State& state,
                                                    const Subject& subject) mutable {
    if (!world) {
      world = std::make_shared<World>(subject.model, option);
      for (int i = 0; i < kFirstSteps; ++i) world->step(subject.step);
    }
    for (auto _ : state) world->step(subject.step);
    state.counters["contacts"] = world->contacts();
    count_springs(state, subject.model, 1);
  };
}

}  // namespace

void register_bullet(Subjects& subjects) {
  for (const Size size : {Size::small, Size::medium}) {
    const auto add = [&](const std::string& kind, auto step) {
      const std::string title = fmt::format("bullet/merged/{}/{}", name(size), kind);
      keep_least(benchmark::RegisterBenchmark(
          title.c_str(), [step, size, &subjects](benchmark::State& state) mutable {
            step(state, subjects.subject(Shape::merged, size));
          }));
    };
    for (const int iterations : {1, 11}) {
      const std::string kind = fmt::format("iterations_{}", iterations);
      add(kind, stepper<PositionBased>(Sweeps{iterations, false}));
      add(kind + "/reordered", stepper<PositionBased>(Sweeps{iterations, true}));
    }
    add("explicit", stepper<Explicit>(true));
    add("explicit_undamped", stepper<Explicit>(false));
  }
}

}  // namespace springlod::bench
