#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace springlod::scripting {

/// The candidate nearest to `name` by edit distance (insert, delete, substitute, transpose); "" if
/// none is near enough for the length of `name`.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'levels'?" or "".
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'levels'? simplify takes: levels, border", without the question if no candidate
/// is near enough; `intro` is "simplify takes".
std::string name_hint(std::string_view name, const std::vector<std::string>& candidates,
                      std::string_view intro);

/// "a, b, c"
std::string comma_list(const std::vector<std::string>& words);

}  // namespace springlod::scripting
