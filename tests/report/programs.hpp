#pragma once

#include <cstdlib>
#include <string>

namespace springlod::test {

/// Changes PATH during its lifetime.
class PathIs {
 public:
  explicit PathIs(const std::string& value) {
    const char* old = std::getenv("PATH");
    old_ = old == nullptr ? "" : old;
    setenv("PATH", value.c_str(), 1);
  }
  ~PathIs() { setenv("PATH", old_.c_str(), 1); }
  PathIs(const PathIs&) = delete;
  PathIs& operator=(const PathIs&) = delete;

 private:
  std::string old_;
};

}  // namespace springlod::test
