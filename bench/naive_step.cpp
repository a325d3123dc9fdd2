#include "bench/naive_step.hpp"

#include <cmath>

namespace springlod::bench {

NaiveBody naive_body(const MassSpringModel& model) {
  NaiveBody body;
  for (const Vec3& x : model.rest) body.x.push_back({x[0], x[1], x[2]});
  body.v.assign(model.node_count(), {0, 0, 0});
  body.f = body.v;
  body.mass = model.mass;
  body.area = model.contact_area;
  body.a = model.a;
  body.b = model.b;
  body.length = model.rest_length;
  body.stiffness = model.stiffness;
  body.damping = model.damping;
  return body;
}

void naive_step(NaiveBody& body, const Floor& floor, double step) {
  for (std::size_t s = 0; s < body.a.size(); ++s) {
    const auto& xa = body.x[body.a[s]];
    const auto& xb = body.x[body.b[s]];
    const auto& va = body.v[body.a[s]];
    const auto& vb = body.v[body.b[s]];
    double d[3] = {xb[0] - xa[0], xb[1] - xa[1], xb[2] - xa[2]};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (double& c : d) c /= length;
    const double rate = d[0] * (vb[0] - va[0]) + d[1] * (vb[1] - va[1]) + d[2] * (vb[2] - va[2]);
    const double tension = body.stiffness[s] * (length - body.length[s]) + body.damping[s] * rate;
    for (int i = 0; i < 3; ++i) {
      body.f[body.a[s]][i] += tension * d[i];
      body.f[body.b[s]][i] -= tension * d[i];
    }
  }
  for (std::size_t n = 0; n < body.x.size(); ++n) {
    const double depth = -body.x[n][2];
    const double push = depth > 0 ? floor.stiffness * body.area[n] * depth : 0;
    const double factor = step / body.mass[n];
    for (int i = 0; i < 3; ++i) body.v[n][i] += factor * body.f[n][i];
    body.v[n][2] += factor * push - step * floor.gravity;
    if (push > 0) {
      const double slip = std::hypot(body.v[n][0], body.v[n][1]);
      const double most = floor.friction * push * factor;
      const double keep = slip > most ? 1 - most / slip : 0;
      body.v[n][0] *= keep;
      body.v[n][1] *= keep;
    }
    for (int i = 0; i < 3; ++i) body.x[n][i] += step * body.v[n][i];
    body.f[n] = {0, 0, 0};
  }
}

}  // namespace springlod::bench
