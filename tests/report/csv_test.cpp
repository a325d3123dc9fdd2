#include "report/csv.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "tests/render/golden.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

TEST_CASE("numbers have their shortest text that parses to the same value") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(-2) == "-2");
  CHECK(number_text(1e300) == "1e+300");
  for (const double v :
       {1. / 3, std::nextafter(1., 2.), 6.02214076e23, std::numeric_limits<double>::denorm_min()})
    CHECK(std::strtod(number_text(v).c_str(), nullptr) == v);
}

TEST_CASE("cells with commas, quotes and line breaks are quoted by RFC 4180") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "table.csv";
  save_csv({{"name", "value"}, {{"a,b", whole(1)}, {"say \"hi\"", "2\n3"}, {"plain", Cell()}}},
           path);
  CHECK(read_file(path) == "name,value\r\n\"a,b\",1\r\n\"say \"\"hi\"\"\",\"2\n3\"\r\nplain,\r\n");
}

TEST_CASE("a CSV file has numbers in full, a terminal four digits of them") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "table.csv";
  const Table table{{"n", "x"}, {{whole(123456789), 1. / 3}, {Cell(), 2.0}}};
  save_csv(table, path);
  CHECK(read_file(path) == "n,x\r\n123456789,0.3333333333333333\r\n,2\r\n");
  CHECK(format_table(table) ==
        "        n       x\n"
        "─────────  ──────\n"
        "123456789  0.3333\n"
        "                2\n");
}

TEST_CASE("a ragged table is refused") {
  const TemporaryFolder folder;
  const Table ragged{{"a", "b"}, {{"1", "2"}, {"3"}}};
  CHECK_THROWS_WITH(save_csv(ragged, folder.path() / "t.csv"), Catch::Contains("row 2"));
  CHECK_THROWS_AS(format_table(ragged), InputError);
}

TEST_CASE("a terminal table right-aligns numbers and counts characters, not bytes") {
  const Table table{
      {"name", "nodes", "error"},
      {{"größe", whole(368), "12.5 %"}, {"LOD-1", whole(67), "-"}, {"x", Cell(), "3 %"}}};
  CHECK(format_table(table) ==
        "name   nodes   error\n"
        "─────  ─────  ──────\n"
        "größe    368  12.5 %\n"
        "LOD-1     67       -\n"
        "x                3 %\n");
}

TEST_CASE("a terminal table of long titles and texts fits 100 columns") {
  const std::string reason =
      "the mesh is flat or empty; it encloses no volume, so no cell has its centre inside";
  Table table{{"mesh", "result"}, {{"a.obj", "failed"}, {"b.obj", "converted"}}};
  for (int i = 0; i < 5; ++i) {
    table.columns.push_back("error of the levels [%]");
    for (auto& row : table.rows) row.push_back(whole(i));
  }
  table.columns.push_back("asset or reason");
  table.rows[0].push_back(reason);
  table.rows[1].push_back("b.glb");
  const std::string text = format_table(table);
  CAPTURE(text);
  std::size_t lines = 0;
  std::size_t characters = 0;
  for (const char c : text) {
    if (c == '\n') {
      CHECK(characters <= 100);
      ++lines;
      characters = 0;
    } else {
      characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80 ? 1 : 0;
    }
  }
  CHECK(lines >= 5);
  CHECK_THAT(text, Catch::Contains("the mesh is flat") && Catch::Contains("b.glb"));
  // A word is never broken, such as the path of a file.
  const std::string path(150, 'p');
  CHECK_THAT(format_table({{"mesh", "asset"}, {{"a", path}}}), Catch::Contains(path));
}
