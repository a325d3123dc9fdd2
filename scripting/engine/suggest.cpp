#include "scripting/engine/suggest.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace springlod::scripting {

namespace {

// Optimal string alignment: Levenshtein distance with transposition of adjacent letters.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  // Accepts one edit, or about a third of the letters if that is more: "rnedr" is near "render",
  // "-o" is not near "--cell".
  std::size_t best = std::max<std::size_t>(1, (name.size() + 1) / 3) + 1;
  std::string found;
  // A typing error leaves a name short; the distance to text of any length takes too long.
  constexpr std::size_t kLongestName = 100;
  if (name.size() > kLongestName) return found;
  for (const std::string& candidate : candidates) {
    const bool longer = name.size() >= 3 && candidate.starts_with(name);
    const std::size_t distance = longer ? 1 : edit_distance(name, candidate);
    if (distance < best) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string near = nearest_name(name, candidates);
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

std::string name_hint(std::string_view name, const std::vector<std::string>& candidates,
                      std::string_view intro) {
  const std::string question = did_you_mean(name, candidates);
  return fmt::format("{} {}: {}", question.empty() ? ";" : question, intro, comma_list(candidates));
}

std::string comma_list(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace springlod::scripting
