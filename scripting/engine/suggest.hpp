#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace springlod::scripting {

/// The candidate that `name` was probably meant to be: the one with the least edits (insert, drop,
/// change, swap), if those are few enough for its length; else "".
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'levels'?" or "".
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'levels'? simplify takes: levels, border", without the question if no candidate
/// is near; `intro` is "simplify takes".
std::string name_hint(std::string_view name, const std::vector<std::string>& candidates,
                      std::string_view intro);

/// "a, b, c"
std::string comma_list(const std::vector<std::string>& words);

}  // namespace springlod::scripting
