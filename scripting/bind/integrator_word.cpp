#include "scripting/bind/integrator_word.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

std::vector<std::string> integrator_words() {
  std::vector<std::string> words;
  for (const sim::Integrator integrator : sim::kIntegrators)
    words.emplace_back(to_string(integrator));
  return words;
}

void read_integrator(TableReader& reader, std::string_view name, sim::Integrator& into) {
  reader.choose(name, into,
                {{"symplectic_euler", sim::Integrator::symplectic_euler},
                 {"velocity_verlet", sim::Integrator::velocity_verlet},
                 {"runge_kutta_4", sim::Integrator::runge_kutta_4},
                 {"backward_euler_cg", sim::Integrator::backward_euler_cg},
                 {"backward_euler_direct", sim::Integrator::backward_euler_direct},
                 {"xpbd", sim::Integrator::xpbd},
                 {"projective_dynamics", sim::Integrator::projective_dynamics}});
}

void read_integrators(TableReader& reader, std::string_view name,
                      std::vector<sim::Integrator>& into) {
  if (!reader.has(name)) return;
  std::vector<std::string> names;
  reader.read(name, names);
  const std::vector<std::string> words = integrator_words();
  into.clear();
  for (const std::string& word : names) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
      reader.refuse(name, fmt::format("a list of {}; got '{}'{}", comma_list(words), word,
                                      did_you_mean(word, words)));
    into.push_back(sim::kIntegrators[static_cast<std::size_t>(found - words.begin())]);
  }
}

}  // namespace springlod::scripting
