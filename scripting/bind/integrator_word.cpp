#include "scripting/bind/integrator_word.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "scripting/engine/suggest.hpp"

namespace springlod {

std::vector<std::string> integrator_words() {
  std::vector<std::string> words;
  for (const Integrator integrator : kIntegrators) words.emplace_back(to_string(integrator));
  return words;
}

void read_integrator(TableReader& reader, std::string_view name, Integrator& into) {
  reader.choose(name, into,
                {{"symplectic_euler", Integrator::symplectic_euler},
                 {"velocity_verlet", Integrator::velocity_verlet},
                 {"runge_kutta_4", Integrator::runge_kutta_4},
                 {"backward_euler_cg", Integrator::backward_euler_cg},
                 {"backward_euler_direct", Integrator::backward_euler_direct},
                 {"xpbd", Integrator::xpbd},
                 {"projective_dynamics", Integrator::projective_dynamics}});
}

void read_integrators(TableReader& reader, std::string_view name, std::vector<Integrator>& into) {
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
    into.push_back(kIntegrators[static_cast<std::size_t>(found - words.begin())]);
  }
}

}  // namespace springlod
