#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/paths.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod::test {

/// Exit code and output of one run of the program.
struct Ran {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built springlod in `folder` with `arguments`, and `input` on stdin.
Ran springlod_run(const std::vector<std::string>& arguments, const std::string& input = "",
                  const std::filesystem::path& folder = source_folder());

/// Runs it, sends it a signal as soon as `mark` appears on its stderr, and waits for its end.
/// Its stderr is a pipe that holds one line. Even if the test reads slowly, the program is
/// therefore still running at the interrupt if it has more than two lines to write after the mark.
Ran springlod_interrupted(const std::vector<std::string>& arguments, const std::string& mark,
                          int signal = SIGINT);

/// The surroundings of the program in a Terminal.
struct TerminalSetup {
  unsigned short columns = 0;  ///< 0: unknown to the program
  unsigned short rows = 0;
  std::vector<std::pair<std::string, std::string>> environment{{"TERM", "dumb"}};
  std::filesystem::path folder{};  ///< where it runs; empty: the current one
};

/// The program in a pseudo-terminal with simulated keyboard input.
class Terminal {
 public:
  explicit Terminal(const std::vector<std::string>& arguments,
                    const std::filesystem::path& state_home, const TerminalSetup& setup = {});
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& keys);
  /// Waits until `text` appears in the output since the last wait; false if the program ended or
  /// hangs.
  bool shows(const std::string& text);
  /// All terminal output so far.
  const std::string& screen() const { return screen_; }
  /// Waits for the program to exit; -1 if it hangs.
  int exit_code();
  void signal(int number) const;

 private:
  bool read_more(int timeout_ms);

  int terminal_ = -1;
  int process_ = -1;
  std::size_t seen_ = 0;
  std::string screen_;
};

std::string slurp(const std::filesystem::path& path);
void spit(const std::filesystem::path& path, const std::string& text);

/// An OBJ file of adjacent boxes along x, each a separate mesh part: "o name".
struct BoxPart {
  std::string name;
  double x0 = 0;
  double x1 = 1;
};
std::string obj_of_boxes(const std::vector<BoxPart>& parts, double width = 1);
/// Converts a bar of `length` x 1 x 1 to the asset `asset` (.glb) by `springlod convert` with
/// `options`. The mesh file is kept beside it.
void make_bar_asset(const std::filesystem::path& asset, double length,
                    const std::vector<std::string>& options);
/// A unit box without its top face.
std::string obj_of_open_box();

}  // namespace springlod::test
