#include <fmt/format.h>

#include "report/export/draft.hpp"
#include "report/export/explicit_step.hpp"
#include "report/export/numpy.hpp"
#include "report/export/tetrahedra.hpp"

namespace springlod::report {
namespace {

// {0}: origin, {1}: step.
constexpr const char* kReader = R"(# {0}
# Use it with newton.solvers.SolverSemiImplicit and steps of at most {1:.3g} s, or with SolverXPBD.
# After finalize(), set model.particle_grid = None: the nodes of one body do not collide.
from pathlib import Path
import newton
import numpy as np


def build(builder=None, tetrahedra=False, file=Path(__file__).with_suffix(".npz")):
    """Adds the body to a ModelBuilder, as springs or as tetrahedra, and returns the builder."""
    a = np.load(file)
    if builder is None:
        builder = newton.ModelBuilder(up_axis=newton.Axis.Z, gravity=float(a["gravity"][2]))
    first = builder.particle_count
    for x, m in zip(a["particle_q"].tolist(), a["particle_mass"].tolist()):
        builder.add_particle(pos=tuple(x), vel=(0.0, 0.0, 0.0), mass=m, radius=0.0)
    if tetrahedra:
        for nodes, moduli in zip(a["tet_indices"].tolist(), a["tet_materials"].tolist()):
            builder.add_tetrahedron(*(first + n for n in nodes), *moduli)
        return builder
    for (i, j), k, c, length in zip(a["spring_indices"].tolist(), a["spring_stiffness"].tolist(),
                                    a["spring_damping"].tolist(), a["spring_rest_length"].tolist()):
        builder.add_spring(first + i, first + j, ke=k, kd=c, control=0.0)
        builder.spring_rest_length[-1] = length
    return builder
)";

std::vector<float> single(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

std::vector<float> single(const std::vector<Vec3>& points) {
  std::vector<float> values;
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(p[axis]));
  return values;
}

void add_springs(NumpyArrays& arrays, const MassSpringModel& model) {
  std::vector<std::int32_t> ends;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    for (const std::uint32_t end : {model.a[s], model.b[s]})
      ends.push_back(static_cast<std::int32_t>(end));
  arrays.add("spring_indices", ends, 2);
  arrays.add("spring_rest_length", single(model.rest_length));
  arrays.add("spring_stiffness", single(model.stiffness));
  arrays.add("spring_damping", single(model.damping));
}

// With Lame's parameters mu and lambda [Pa], and no damping.
void add_tetrahedra(NumpyArrays& arrays, const MassSpringModel& model, const Tetrahedra& of) {
  const std::vector<double> young = young_of(model, of), poisson = poisson_of(model, of);
  std::vector<std::int32_t> nodes;
  std::vector<double> moduli;
  for (std::uint32_t t = 0; t < of.count(); ++t) {
    nodes.insert(nodes.end(), of.nodes[t].begin(), of.nodes[t].end());
    const double mu = young[t] / (2 * (1 + poisson[t]));
    moduli.insert(moduli.end(), {mu, 2 * mu * poisson[t] / (1 - 2 * poisson[t]), 0});
  }
  arrays.add("tet_indices", nodes, 4);
  arrays.add("tet_materials", single(moduli), 3);
}

}  // namespace

ExportDraft draft_newton(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  const double step = explicit_step(model);
  NumpyArrays arrays;
  arrays.add("particle_q", single(model.rest), 3);
  arrays.add("particle_mass", single(model.mass));
  arrays.add("gravity", single(std::vector<Vec3>{body.gravity}));
  arrays.add("largest_step", std::vector<double>{step});
  add_springs(arrays, model);
  ExportDraft draft;
  draft.settings = {explicit_step_line(model, step),
                    "solver: newton.solvers.SolverSemiImplicit; no self-collision of the nodes: "
                    "model.particle_grid = None"};
  draft.losses = lost_beside_springs(model);
  const Tetrahedra tetrahedra = tetrahedra_of_cells(model);
  if (tetrahedra.empty()) {
    draft.losses.push_back(no_tetrahedra(model));
  } else {
    add_tetrahedra(arrays, model, tetrahedra);
    draft.settings.emplace_back(
        "tetrahedra: SolverVBD takes their Lame parameters as they are; SolverSemiImplicit's "
        "energy "
        "takes 4/3 mu and lambda + 5/6 mu (Smith et al. 2018), and a step of its own");
    draft.losses.emplace_back(
        "damping of the tetrahedra: their k_damp is 0; the springs have theirs");
  }
  draft.losses.emplace_back("double precision: Warp computes in single");
  if (body.surface) draft.losses.emplace_back("the surface of the body");
  draft.files = {{".npz", arrays.file()}, {".py", fmt::format(kReader, body.origin, step)}};
  return draft;
}

}  // namespace springlod::report
