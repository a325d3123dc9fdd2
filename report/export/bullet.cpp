// Bullet: code in C++ that builds a btSoftBody for its position-based solver.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "elastic/stable_step.hpp"
#include "report/export/arrays.hpp"
#include "report/export/draft.hpp"
#include "report/export/substep_window.hpp"

namespace springlod::report {

namespace {

constexpr const char* kHead = R"(#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <BulletSoftBody/btSoftBody.h>

)";

// Bullet corrects a link by C / c0 with c0 = (1/m_a + 1/m_b) / kLST, once an iteration. One
// iteration is a substep of XPBD with the compliance 1 / k if c0 = 1/m_a + 1/m_b + 1 / (k dt^2).
// The other corrections soften the link as half of 1/m_a + 1/m_b would, so that half is left out.
constexpr const char* kBuild = R"(
/// A soft body with its middle at `position`; nodes of `held` do not move. The world must be a
/// btSoftRigidDynamicsWorld that is stepped by `step` seconds:
///   world.stepSimulation(frame, 1000, kStep);
/// The stiffness of links in Bullet depends on the step and the iterations, which must stay 1.
inline btSoftBody* make_soft_body(
    btSoftBodyWorldInfo& world, const std::vector<std::uint32_t>& held = {},
    const btVector3& position = btVector3(kCenter[0], kCenter[1], kCenter[2]),
    btScalar step = kStep) {
  std::vector<btVector3> places;
  std::vector<btScalar> masses;
  for (std::uint32_t n = 0; n < kNodes; ++n) {
    places.push_back(position +
                     btVector3(kPosition[3 * n], kPosition[3 * n + 1], kPosition[3 * n + 2]));
    masses.push_back(kMass[n]);
  }
  for (const std::uint32_t n : held) masses[n] = 0;
  auto* body =
      new btSoftBody(&world, static_cast<int>(kNodes), places.data(), masses.data());
  for (std::uint32_t s = 0; s < kSprings; ++s) {
    const int a = static_cast<int>(kEnds[2 * s]), b = static_cast<int>(kEnds[2 * s + 1]);
    const btScalar mobility = body->m_nodes[a].m_im + body->m_nodes[b].m_im;
    // A link of stiffness k [N/m]: Bullet divides the correction by mobility / kLST.
    btSoftBody::Material* material = body->appendMaterial();
    material->m_kLST =
        std::min(mobility / (mobility / 2 + 1 / (kStiffness[s] * step * step)), btScalar(1));
    body->appendLink(a, b, material);
    body->m_links[static_cast<int>(s)].m_rl = kRestLength[s];
  }
  body->m_cfg.piterations = 1;
  body->m_cfg.kDP = 0;
  body->updateConstants();
  return body;
}
)";

}  // namespace

ExportDraft draft_bullet(const ExportedModel& body) {
  const SingleBody single = single_body(body);
  // Bullet stores the nodes of all bodies in the axes of the world.
  float extent = single.extent;
  for (const float coordinate : single.center)
    extent = std::max(extent, std::abs(coordinate) + single.extent);
  const SubstepWindow window = substep_window(body.model, body.gravity.norm(), extent);
  const int rate = frame_substeps(window).per_second();
  ExportDraft draft;
  draft.settings = {fmt::format("step 1/{} s and one position iteration; kDP 0", rate)};
  for (std::string& line : describe_window(window)) draft.settings.push_back(std::move(line));
  draft.losses = lost_beside_springs(body.model);
  if (elastic::largest_damping_time(body.model) > 0)
    draft.losses.push_back("damping of springs: Bullet has none, but its solver damps vibrations");
  draft.losses.push_back(
      "linear springs: at a strain e, a link of Bullet is stiffer by about e / 2");
  draft.losses.push_back("double precision: Bullet is compiled with single, as a rule");
  std::string text = fmt::format(
      "// {} for Bullet, by {}.\n// SI units, y is up: the asset's (x, y, "
      "z) is (x, z, -y) here.\n",
      body.name, body.origin);
  for (const std::string& line : draft.settings) text += fmt::format("// {}\n", line);
  for (const std::string& loss : draft.losses) text += fmt::format("// Not here: {}\n", loss);
  text += kHead;
  text += fmt::format(
      "namespace {} {{\n\ninline constexpr btScalar kStep = btScalar(1) / {};  ///< "
      "[s]\n",
      body.name, rate);
  text += cpp_arrays(single) + kBuild + fmt::format("\n}}  // namespace {}\n", body.name);
  draft.files = {{".hpp", std::move(text)}};
  return draft;
}

}  // namespace springlod::report
