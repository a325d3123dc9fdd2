#include "scripting/engine/file_access.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::scripting {

namespace fs = std::filesystem;

namespace {

// "folder/" has an empty last element.
fs::path without_slash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

fs::path with_links(const fs::path& path) {
  std::error_code error;
  return without_slash(fs::absolute(path, error).lexically_normal());
}

fs::path without_links(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? with_links(path) : without_slash(canonical);
}

// "ball.calibration" and "ball-2.glb" after "ball".
bool is_named_after(const fs::path& name, const fs::path& stem) {
  return name.native().starts_with(stem.native() + ".") ||
         name.native().starts_with(stem.native() + "-");
}

bool is_hidden(const fs::path& name) {
  return name.native().starts_with('.');
}

[[noreturn]] void refuse(const fs::path& path, const char* what) {
  throw InputError(fmt::format(
      "the script may not {} {}: name it as an argument of the command, use the current folder (no "
      "hidden files), or lift the sandbox with springlod --unsafe",
      what, path.string()));
}

}  // namespace

/// A path, absolute and without "..".
struct FileAccess::Name {
  explicit Name(const fs::path& path) : linked(with_links(path)), real(without_links(path)) {}
  fs::path linked;
  fs::path real;
};

void FileAccess::allow_project(const fs::path& folder) {
  rules_.push_back({.path = without_links(folder), .writing = true, .hidden = false});
}

void FileAccess::allow_named(const fs::path& path) {
  if (path.empty()) return;  // an empty path would lead to all files
  std::error_code error;
  const fs::path full = without_links(path);
  rules_.push_back({.path = full, .writing = true, .siblings = !fs::is_directory(full, error)});
}

void FileAccess::allow_reading(const fs::path& folder) {
  rules_.push_back({.path = without_links(folder)});
}

void FileAccess::allow_modules(const fs::path& folder) {
  rules_.push_back({.path = with_links(folder), .links = true});
}

bool FileAccess::covers(const Rule& rule, const Name& name) {
  const fs::path& path = rule.links ? name.linked : name.real;
  const auto [end, rest] =
      std::mismatch(rule.path.begin(), rule.path.end(), path.begin(), path.end());
  if (end == rule.path.end()) return rule.hidden || std::none_of(rest, path.end(), is_hidden);
  const bool beside = std::next(end) == rule.path.end() && rest != path.end();
  return rule.siblings && beside && is_named_after(*rest, rule.path.stem());
}

bool FileAccess::may_write(const fs::path& path) const {
  const Name full(path);
  return !restricted_ || std::any_of(rules_.begin(), rules_.end(), [&](const Rule& rule) {
    return rule.writing && covers(rule, full);
  });
}

bool FileAccess::may_read(const fs::path& path) {
  const Name full(path);
  const bool allowed =
      !restricted_ || std::any_of(rules_.begin(), rules_.end(),
                                  [&](const Rule& rule) { return covers(rule, full); });
  if (allowed) read_.insert(full.real);
  return allowed;
}

void FileAccess::require_readable(const fs::path& path) {
  if (!may_read(path)) refuse(path, "read");
}

void FileAccess::require_writable(const fs::path& path) const {
  if (!may_write(path)) refuse(path, "write to");
}

}  // namespace springlod::scripting
