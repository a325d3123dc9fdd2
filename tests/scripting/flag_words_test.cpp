// Options of the API as flags of a command line.

#include "scripting/engine/flag_words.hpp"

#include <catch2/catch.hpp>

using springlod::scripting::FlagWords;

namespace {

FlagWords of_convert() {
  FlagWords words;
  words.use({{"hinges", "--hinges"},
             {"levels", "--levels"},
             {"border", "--border"},
             {"unit", "--unit"},
             {"guards", "--no-guards"},
             {"cut_cells", "--cut-cells"},
             {"keep", "--keep"},
             {"style", "--lattice"}},
            {"voxelize", "simplify", "lattice"});
  return words;
}

}  // namespace

TEST_CASE("Messages name an option by its flag, with its value as on a command line") {
  const FlagWords words = of_convert();
  CHECK(words.in_flags("hinges = \"fill\" or \"separate\" removes them") ==
        "--hinges fill or separate removes them");
  CHECK(words.in_flags("use levels = 8 or border = \"weak\"") == "use --levels 8 or --border weak");
  CHECK(words.in_flags("lattice: cut cells are for style = \"corners\"; make the grid without "
                       "cut_cells") ==
        "cut cells are for --lattice corners; make the grid without --cut-cells");
  CHECK(words.in_flags("(the option unit changes it)") == "(--unit changes it)");
  CHECK(words.in_flags("simplify: levels must be 1 or more") == "--levels must be 1 or more");
  CHECK(words.in_flags("change keep, or leave it out; leave out border") ==
        "change --keep, or leave it out; leave out --border");
}

TEST_CASE("An option that a flag switches off is named by what to do with the flag") {
  const FlagWords words = of_convert();
  CHECK(words.in_flags("use guards = true, which fuses them") ==
        "leave out --no-guards, which fuses them");
  CHECK(words.in_flags("guards = false leaves them") == "--no-guards leaves them");
  CHECK(words.in_flags("cut_cells = true counts them") == "--cut-cells counts them");
}

TEST_CASE("What is no option stays as it is, and all messages do without flags") {
  const FlagWords words = of_convert();
  for (const char* message :
       {"assumed 1 unit = 0.1 m", "the bodies keep their levels", "grading = 2 must be from 0 to 1",
        "part \"rod\": levels", "cannot read unit: none", ""})
    CHECK(words.in_flags(message) == message);
  const std::string endless = "use levels = " + std::string(1000000, '8');
  CHECK(words.in_flags(endless) == endless);
  const std::string option = "simplify: use guards = true";
  CHECK(FlagWords().in_flags(option) == option);
}
