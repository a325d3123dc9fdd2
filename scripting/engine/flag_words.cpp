#include "scripting/engine/flag_words.hpp"

#include <optional>
#include <regex>
#include <utility>

#include <fmt/format.h>

namespace springlod::scripting {

namespace {

using Match = std::match_results<std::string::const_iterator>;

// Replaces every match for which `make` returns a text.
template <class Make>
std::string replaced(const std::string& text, const std::regex& pattern, const Make& make) {
  std::string result;
  auto from = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    const Match& match = *at;
    result.append(from, match[0].first);
    const std::optional<std::string> made = make(match);
    result += made ? *made : match.str();
    from = match[0].second;
  }
  return result.append(from, text.cend());
}

std::string without_quotes(std::string text) {
  std::erase(text, '"');
  return text;
}

}  // namespace

void FlagWords::use(std::map<std::string, std::string> flags, std::set<std::string> functions) {
  flags_ = std::move(flags);
  functions_ = std::move(functions);
}

std::string FlagWords::in_flags(std::string_view message) const {
  std::string text(message);
  // The matching of patterns needs stack for each character; messages are far shorter.
  constexpr std::size_t kLongest = 4000;
  if (flags_.empty() || text.size() > kLongest) return text;
  const auto flag = [&](const std::string& option) -> std::optional<std::string> {
    const auto found = flags_.find(option);
    return found == flags_.end() ? std::nullopt : std::optional(found->second);
  };

  static const std::regex function("^([a-z_ ]+): ");
  text = replaced(text, function, [&](const Match& m) -> std::optional<std::string> {
    return functions_.contains(m.str(1)) ? std::optional<std::string>("") : std::nullopt;
  });

  // levels must be 1 or more
  static const std::regex subject(R"(^(\w+)(\[\d+\])? (must|has|is|asks|cannot)\b)");
  text = replaced(text, subject, [&](const Match& m) -> std::optional<std::string> {
    const auto name = flag(m.str(1));
    return name ? std::optional(fmt::format("{} {}", *name, m.str(3))) : std::nullopt;
  });

  // guards = true, and `use guards = true` if its flag switches guards off
  static const std::regex boolean(R"((?:\b(use|keep) )?\b(\w+) = (true|false)\b)");
  text = replaced(text, boolean, [&](const Match& m) -> std::optional<std::string> {
    const auto name = flag(m.str(2));
    if (!name) return std::nullopt;
    const bool sets = name->starts_with("--no-") == (m.str(3) == "false");
    if (sets) return m[1].matched ? fmt::format("{} {}", m.str(1), *name) : *name;
    return (m[1].matched ? "leave out " : "without ") + *name;
  });

  // hinges = "fill" or "separate"
  static const std::regex words(R"re(\b(\w+) = ("[^"]*"(?:(?: or |, )"[^"]*")*))re");
  text = replaced(text, words, [&](const Match& m) -> std::optional<std::string> {
    const auto name = flag(m.str(1));
    return name ? std::optional(fmt::format("{} {}", *name, without_quotes(m.str(2))))
                : std::nullopt;
  });

  // levels = 2, but not "1 unit = 0.1 m"
  static const std::regex number(R"((\d )?\b(\w+) = (?=\S))");
  text = replaced(text, number, [&](const Match& m) -> std::optional<std::string> {
    const auto name = flag(m.str(2));
    return name && !m[1].matched ? std::optional(*name + " ") : std::nullopt;
  });

  static const std::regex named(
      R"(\b(the option |options\.|leave out |leave |change |without )(\w+)\b)");
  text = replaced(text, named, [&](const Match& m) -> std::optional<std::string> {
    const auto name = flag(m.str(2));
    if (!name) return std::nullopt;
    const bool only_marks = m.str(1) == "the option " || m.str(1) == "options.";
    return only_marks ? *name : m.str(1) + *name;
  });

  // Names that are no words of the language: cut_cells
  static const std::regex joined(R"((^|[^-\w])(\w+_\w+)\b)");
  text = replaced(text, joined, [&](const Match& m) -> std::optional<std::string> {
    const auto name = flag(m.str(2));
    return name ? std::optional(m.str(1) + *name) : std::nullopt;
  });
  return text;
}

}  // namespace springlod::scripting
