#include "sweep/work_lines.hpp"

#include <catch2/catch.hpp>

namespace springlod::sweep {
namespace {

std::string without_end(std::string line) {
  REQUIRE(line.back() == '\n');
  line.pop_back();
  return line;
}

TEST_CASE("Lines of workers are read as they were written, each as its own kind") {
  const std::string order = without_end(line_of(Order{3, 9}));
  REQUIRE(order_of(order));
  CHECK(order_of(order)->end == 9);
  const std::string report = without_end(line_of(Report{Report::Kind::begun, 12, 2}));
  REQUIRE(report_of(report));
  CHECK(report_of(report)->kind == Report::Kind::begun);
  CHECK(report_of(report)->unit == 12);
  CHECK(report_of(report)->number == 2);
  CHECK_FALSE(error_of(report));
  const std::string error = without_end(line_of_error("a full disk:\nno space"));
  CHECK(error_of(error) == "a full disk: no space");
  CHECK_FALSE(report_of(error));
  CHECK_FALSE(order_of(error));
}

}  // namespace
}  // namespace springlod::sweep
