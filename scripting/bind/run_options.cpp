#include "scripting/bind/run_options.hpp"

#include <fmt/format.h>

#include "scripting/bind/integrator_word.hpp"

namespace springlod::scripting {

std::vector<Parameter> run_parameters(const sim::RunOptions& usual) {
  return {{.name = "integrator",
           .type = "one of",
           .fallback = "\"symplectic_euler\"",
           .help = "how a step is made; the first three are explicit, the others go on at any step",
           .choices = integrator_words()},
          {.name = "iterations",
           .type = "integer",
           .fallback = "20 of Newton, 1 sweep of xpbd, 10 of projective_dynamics",
           .help = "of the implicit schemes, a step"},
          {.name = "tolerance",
           .type = "number",
           .fallback = fmt::format("{}", usual.solver.tolerance),
           .help = "part of the forces at which backward Euler stops iterating"},
          {.name = "linear_iterations",
           .type = "integer",
           .fallback = "twice the unknowns",
           .help = "of the conjugate gradients inside one iteration of Newton, at most"},
          {.name = "step",
           .type = "quantity",
           .dimension = Dimension::time,
           .fallback = "safety times the predicted stable step; 1 ms for the implicit schemes",
           .help = "time step"},
          {.name = "safety",
           .type = "number",
           .fallback = fmt::format("{}", usual.safety),
           .help = "part of the predicted stable step that is taken"},
          {.name = "precision",
           .type = "one of",
           .fallback = "\"double\"",
           .help = "of the numbers symplectic_euler moves a body with; a step in single takes some "
                   "two thirds of the time, docs/precision.md tells what it costs",
           .choices = {"double", "single"}},
          {.name = "layout",
           .type = "one of",
           .fallback = "\"fastest\"",
           .help = "of the springs for symplectic_euler: the fastest, rows for a lattice, or that "
                   "for \"any shape\", to time a lattice and its levels by one kernel",
           .choices = {"fastest", "any shape"}},
          {.name = "contact",
           .type = "one of",
           .fallback = "\"nodes\"",
           .help = "where a level touches obstacles: at its own nodes, which lie inside its base's "
                   "surface, or at the base's \"surface\", which its nodes carry",
           .choices = {"nodes", "surface"}},
          {.name = "sleep",
           .type = "number",
           .fallback = fmt::format("{}", usual.sleep),
           .help = "a body that touches something sleeps, at no cost, once its mean speed stays "
                   "below this part of that of a fall through its own size; 0: never"},
          {.name = "frame_rate",
           .type = "number",
           .fallback = fmt::format("{}", usual.frame_rate),
           .help = "frames kept a simulated second; 0: first and last only"},
          {.name = "ledger",
           .type = "boolean",
           .fallback = usual.ledger ? "true" : "false",
           .help = "keep account of the energy"}};
}

void read_run_options(Call& call, TableReader& reader, sim::RunOptions& options) {
  read_integrator(reader, "integrator", options.integrator);
  reader.read("iterations", options.solver.iterations);
  reader.read("tolerance", options.solver.tolerance);
  reader.read("linear_iterations", options.solver.linear_iterations);
  reader.read("step", options.step);
  reader.read("safety", options.safety);
  reader.choose(
      "precision", options.precision,
      {{"double", sim::Precision::double_precision}, {"single", sim::Precision::single_precision}});
  reader.choose("layout", options.layout,
                {{"fastest", sim::Layout::fastest}, {"any shape", sim::Layout::any_shape}});
  reader.read("sleep", options.sleep);
  reader.read("frame_rate", options.frame_rate);
  reader.read("ledger", options.ledger);
  options.progress = call.progress();
}

sim::ContactAt read_contact(TableReader& reader) {
  sim::ContactAt contact = sim::ContactAt::nodes;
  reader.choose("contact", contact,
                {{"nodes", sim::ContactAt::nodes}, {"surface", sim::ContactAt::surface}});
  return contact;
}

std::shared_ptr<const sim::ContactSkin> skin_of(const ModelValue& model, sim::ContactAt contact) {
  if (contact == sim::ContactAt::nodes || !model.chain || model.level == 0) return nullptr;
  return std::make_shared<sim::ContactSkin>(sim::contact_skin(model.chain->chain, model.level));
}

}  // namespace springlod::scripting
