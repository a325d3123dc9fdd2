#include "report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/subprocess.hpp"
#include "render/frames.hpp"
#include "report/chart_layout.hpp"
#include "tests/render/golden.hpp"
#include "tests/report/programs.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

namespace {

const ChartOptions kOptions{"Cost against error", "spring updates", "error [m]", true, false};

std::vector<ChartSeries> some_series() {
  return {{"base", {{4.1e9, 0, "base"}}, false},
          {"LOD_hb", {{1.7e9, 0.021, "it's \"1\"", 0.018, 0.025}, {6.1e8, 0.055, "a, b^2"}}},
          {"empty", {}}};
}

}  // namespace

TEST_CASE("a chart is drawn with its labels, and script and data are kept beside it") {
  if (!find_program("gnuplot")) {
    WARN("gnuplot is not installed: not tested");
    return;
  }
  const TemporaryFolder folder;
  const auto path = folder.path() / "it's here" / "cost.svg";
  const ChartFiles files = draw_chart(some_series(), kOptions, path);
  REQUIRE(files.drawn);
  const std::string svg = read_file(path);
  for (const char* text : {"Cost against error", "spring updates", "error [m]", "LOD_hb", "a, b^2"})
    CHECK(svg.find(text) != std::string::npos);
  CHECK(std::filesystem::exists(files.data));
  CHECK(read_file(files.data).find("LOD_hb,1.7e+09,0.021,0.018,0.025") != std::string::npos);
  CHECK(svg.find("empty") != std::string::npos);  // in the legend, without a point

  // The same input gives the same bytes: no date, no process number inside.
  const auto again = folder.path() / "again" / "cost.svg";
  draw_chart(some_series(), kOptions, again);
  CHECK(read_file(again) == svg);

  // The command reproduces the same picture.
  std::filesystem::remove(path);
  REQUIRE(std::system(files.command.c_str()) == 0);
  CHECK(read_file(path) == svg);
}

TEST_CASE("quotes and line breaks in names leave the points of other series where they are") {
  const TemporaryFolder folder;
  const PathIs nothing("");  // gnuplot is not found: the test reads the data
  const std::vector<ChartSeries> series{{"it's \"a\", b\nc", {{1, 2, "d\n\"e\""}}},
                                        {"next", {{3, 4, ""}}}};
  const std::string data =
      read_file(draw_chart(series, kOptions, folder.path() / "names.svg").data);
  CHECK(std::count(data.begin(), data.end(), '\n') == 3);  // the head and a row for each point
  CHECK(data.find("\"it's 'a', b c\",1,2,2,2,d 'e',1,1") != std::string::npos);
}

TEST_CASE("a chart can be a PNG") {
  if (!find_program("gnuplot")) {
    WARN("gnuplot is not installed: not tested");
    return;
  }
  const TemporaryFolder folder;
  REQUIRE(draw_chart(some_series(), kOptions, folder.path() / "cost.png").drawn);
  const render::Image image = render::load_png(folder.path() / "cost.png");
  CHECK(image.width == 900);
  CHECK(image.height == 600);
}

TEST_CASE("points have intervals in x and y, and series have their own styles") {
  const TemporaryFolder folder;
  const PathIs nothing("");  // gnuplot is not found: the test reads the script
  ChartOptions options{"Looks", "x", "y", true, true};
  options.width = 1200;
  options.height = 800;
  options.y_from = 0.1;
  const ChartPoint both{2, 3, "both", 2.5, 3.5, 1.5, 2.75};
  const std::vector<ChartSeries> series{
      {"own",
       {both, {4, 0.05, "low", 0, 0, 0, 0}},
       false,
       false,
       ChartColour::black,
       ChartSymbol::diamond},
      {"floor", {{1, 1, ""}, {8, 1, ""}}, true, true, {}, ChartSymbol::none},
      {"around", {{2, 3, ""}}, false, false, {}, ChartSymbol::ring},
      {"told", {}, false, false, ChartColour::sky, ChartSymbol::square}};
  const ChartFiles files = draw_chart(series, options, folder.path() / "looks.svg");
  CHECK(read_file(files.data).find("own,2,3,2.5,3.5,both,1.5,2.75") != std::string::npos);
  const std::string script = read_file(files.script);
  const auto has = [&](const char* text) {
    CAPTURE(text, script);
    CHECK(script.find(text) != std::string::npos);
  };
  has("size 1200,800");
  has("using 2:3:7:8:4:5 with xyerrorbars pt 0 lw 1.2 lc rgb '#14171B'");
  has("with points pt 13 ps 1.2 lw 2 lc rgb '#14171B' title 'own'");
  has("with lines lw 2 dt 2 lc rgb '#D55E00' title 'floor'");
  has("with points pt 6 ps 2.4 lw 2 lc rgb '#009E73' title 'around'");
  has("NaN with points pt 5 ps 1.2 lw 2 lc rgb '#56B4E9' title 'told'");
  // Points below the axis are drawn hollow on it, with their value as label.
  has("'low (y = 0.05)'");
  has("point pt 12 ps 1.2 lc rgb '#14171B'");
}

TEST_CASE("a series of very many points has small symbols") {
  const TemporaryFolder folder;
  const PathIs nothing("");  // gnuplot is not found: the test reads the script
  std::vector<ChartSeries> series{{"cloud", {}, false}, {"few", {{1, 1, ""}}, false}};
  for (int i = 0; i <= 400; ++i) series[0].points.push_back({1 + 0.01 * i, 2, ""});
  const std::string script =
      read_file(draw_chart(series, kOptions, folder.path() / "cloud.svg").script);
  CHECK(script.find("pt 7 ps 0.6 lw 2 lc rgb '#0072B2' title 'cloud'") != std::string::npos);
  CHECK(script.find("pt 5 ps 1.2 lw 2 lc rgb '#D55E00' title 'few'") != std::string::npos);
}

TEST_CASE("without gnuplot a chart keeps script, data and the command") {
  const TemporaryFolder folder;
  const PathIs nothing("");
  const ChartFiles files = draw_chart(some_series(), kOptions, folder.path() / "cost.svg");
  CHECK_FALSE(files.drawn);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "cost.svg"));
  CHECK(std::filesystem::exists(files.script));
  CHECK(std::filesystem::exists(files.data));
  CHECK(files.command == "cd " + folder.path().string() + " && gnuplot cost.gp");
}

TEST_CASE("a failing gnuplot is reported with what it said") {
  const TemporaryFolder folder;
  const auto fake = folder.path() / "gnuplot";
  std::ofstream(fake) << "#!/bin/sh\necho no such terminal >&2\nexit 3\n";
  std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
  const PathIs only_fake(folder.path().string());
  CHECK_THROWS_WITH(draw_chart(some_series(), kOptions, folder.path() / "cost.svg"),
                    Catch::Contains("no such terminal") && Catch::Contains("exit 3"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "cost.svg"));
}

TEST_CASE("charts without points, with NaN or with another extension are refused") {
  const TemporaryFolder folder;
  ChartPoint nowhere;
  nowhere.y = NAN;
  CHECK_THROWS_AS(draw_chart({}, kOptions, folder.path() / "a.svg"), InputError);
  CHECK_THROWS_AS(draw_chart({{"a", {}}}, kOptions, folder.path() / "a.svg"), InputError);
  CHECK_THROWS_AS(draw_chart({{"a", {nowhere}}}, kOptions, folder.path() / "a.svg"), InputError);
  CHECK_THROWS_WITH(draw_chart(some_series(), kOptions, folder.path() / "a.pdf"),
                    Catch::Contains(".svg or .png"));
}

TEST_CASE("axes contain all values and have a few round ticks") {
  struct Case {
    std::vector<double> values;
    bool log;
  };
  for (const Case& c : {Case{{0.018, 0.062}, false}, Case{{-3, 1e6}, false}, Case{{5}, false},
                        Case{{0}, false}, Case{{1e9, 4e9}, true}, Case{{1e-3, 1e4}, true},
                        Case{{1e-12, 1e12}, true}, Case{{7}, true}, Case{{0, 2}, true}}) {
    const Axis axis = make_axis(c.values, c.log);
    CHECK(axis.low < axis.high);
    for (const double v : c.values) {
      CHECK(axis.place(v) >= 0);
      CHECK(axis.place(v) <= 1);
    }
    CHECK(axis.ticks.size() >= 2);
    CHECK(axis.ticks.size() <= 12);
    for (const Tick& tick : axis.ticks) {
      CHECK(axis.place(tick.value) >= -1e-9);
      CHECK(axis.place(tick.value) <= 1 + 1e-9);
    }
  }
}

TEST_CASE("ticks have short labels") {
  CHECK(tick_text(0) == "0");
  CHECK(tick_text(0.05) == "0.05");
  CHECK(tick_text(2e9) == "2·10⁹");
  CHECK(tick_text(1e-6) == "10⁻⁶");
  CHECK(tick_text(-5e7) == "-5·10⁷");
}

TEST_CASE("log axes have powers of ten, whatever their length") {
  const auto texts = [](const std::vector<double>& values, bool log) {
    std::vector<std::string> all;
    for (const Tick& tick : make_axis(values, log).ticks) all.push_back(tick.text);
    return all;
  };
  const auto has = [&](const std::vector<std::string>& all, const char* text) {
    return std::find(all.begin(), all.end(), text) != all.end();
  };
  for (const std::vector<double>& values :
       {std::vector{1e-7, 1.}, {1e-4, 1e-2}, {8e-4, 4e-3}, {9e-4, 1.1e-3}}) {
    const std::vector<std::string> all = texts(values, true);
    CAPTURE(all);
    CHECK(has(all, "10⁻³"));
    CHECK_FALSE(has(all, "0.001"));
  }
  CHECK(has(texts({1e-4, 1e-2}, true), "2·10⁻³"));
  CHECK(has(texts({1, 1e5}, true), "10⁴"));
  CHECK(has(texts({0, 0.004}, false), "0.001"));  // a linear axis
}

TEST_CASE("labels of neighbouring points do not overlap") {
  std::vector<ChartSeries> series{{"a", {}, false}};
  for (const double x : {1., 1.02, 1.04, 1.5})
    series[0].points.push_back({x, 2 + x, "point " + std::to_string(x)});
  const Axis x_axis = make_axis({1, 2}, false);
  const Axis y_axis = make_axis({3, 4}, false);
  const ChartFrame frame;
  const auto labels = place_labels(series, x_axis, y_axis, frame);
  REQUIRE(labels.size() == 4);
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = i + 1; j < labels.size(); ++j) {
      const double dx = std::abs(labels[i].x - labels[j].x) * (frame.right - frame.left);
      const double dy = std::abs(labels[i].y - labels[j].y) * (frame.bottom - frame.top);
      const bool beside = labels[i].anchor != labels[j].anchor;
      CHECK((beside || dy >= frame.font || dx >= text_width(labels[i].text, frame.font * 0.9)));
    }
}

TEST_CASE("each of two labels is nearer to its own point") {
  const ChartFrame frame;
  const Axis axis = make_axis({0, 10}, false);
  const double width = frame.right - frame.left;
  const double height = frame.bottom - frame.top;
  for (const double apart : {4., 9., 16., 24.})  // [px]
    for (int angle = 0; angle < 360; angle += 30) {
      const double dx = apart * std::cos(angle * kPi / 180) / width * (axis.high - axis.low);
      const double dy = apart * std::sin(angle * kPi / 180) / height * (axis.high - axis.low);
      const std::vector<ChartSeries> series{{"a", {{5, 5, "level 1"}}},
                                            {"b", {{5 + dx, 5 + dy, "level 2"}}}};
      const auto labels = place_labels(series, axis, axis, frame);
      const auto distance = [&](const PlacedLabel& from, const PlacedLabel& to) {
        const double wide = text_width(from.text, frame.font * kLabelFont);
        const double x = (from.x - to.point_x) * width;  // of the anchor of the text
        const double left = from.anchor == TextAnchor::left    ? x
                            : from.anchor == TextAnchor::right ? x - wide
                                                               : x - wide / 2;
        const double y = std::abs(from.y - to.point_y) * height - frame.font / 2;
        return std::hypot(std::max({left, -left - wide, 0.}), std::max(y, 0.));
      };
      CAPTURE(apart, angle);
      CHECK(distance(labels[0], labels[0]) <= distance(labels[0], labels[1]));
      CHECK(distance(labels[1], labels[1]) <= distance(labels[1], labels[0]));
      // Of symbols that overlap, only lines show whose labels they are.
      CHECK(labels[0].led == (apart < 12));
      CHECK(labels[1].led == (apart < 12));
    }
}

TEST_CASE("a label in a crowd is moved away from its point and joined to it by a line") {
  const ChartFrame frame;
  const Axis axis = make_axis({0, 10}, false);
  std::vector<ChartSeries> alone{{"a", {}, false}};
  alone[0].points.push_back({5, 5, "here"});
  CHECK_FALSE(place_labels(alone, axis, axis, frame).at(0).led);

  std::vector<ChartSeries> crowd = alone;
  for (int x = -4; x <= 4; ++x)
    for (int y = -2; y <= 2; ++y) {
      ChartPoint& point = crowd[0].points.emplace_back();
      point.x = 5 + 0.15 * x;
      point.y = 5 + 0.25 * y;
    }
  const PlacedLabel label = place_labels(crowd, axis, axis, frame).at(0);
  CHECK(label.led);
  CHECK(label.point_x == Approx(axis.place(5)));
  // Outside the crowded region, whose half height is 0.5.
  const double height = axis.place(0.5) - axis.place(0);
  const double width = axis.place(0.6) - axis.place(0);
  CHECK((std::abs(label.y - label.point_y) > height || std::abs(label.x - label.point_x) > width));
}
