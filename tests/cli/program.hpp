#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace springlod::test {

/// How one run of the real program ended.
struct Ran {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs build/app/springlod with `arguments`, `input` on its stdin, in `folder`.
Ran springlod_run(const std::vector<std::string>& arguments, const std::string& input = "",
                  const std::filesystem::path& folder = SPRINGLOD_SOURCE_DIR);

/// Runs it, interrupts it (SIGINT) as soon as `mark` shows on its stderr, and waits for its end.
/// However slowly the test reads, the program is still at work then if it has more than two lines
/// left to write after the mark: its stderr is a pipe that holds one line.
Ran springlod_interrupted(const std::vector<std::string>& arguments, const std::string& mark);

/// The program in a terminal of its own, its keyboard in our hands.
class Terminal {
 public:
  explicit Terminal(const std::vector<std::string>& arguments,
                    const std::filesystem::path& state_home);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& keys);
  /// Waits until `text` shows in what came since the last wait; false if nothing more comes, for
  /// the program ended or hangs.
  bool shows(const std::string& text);
  /// All that came on the screen so far.
  const std::string& screen() const { return screen_; }
  /// Waits for the program to leave; -1 if it hangs.
  int exit_code();

 private:
  bool read_more(int timeout_ms);

  int terminal_ = -1;
  int process_ = -1;
  std::size_t seen_ = 0;
  std::string screen_;
};

std::string slurp(const std::filesystem::path& path);
void spit(const std::filesystem::path& path, const std::string& text);

/// An OBJ of boxes standing side by side along x, each a part of its own: "o name".
struct BoxPart {
  std::string name;
  double x0 = 0;
  double x1 = 1;
};
std::string obj_of_boxes(const std::vector<BoxPart>& parts, double width = 1);
/// Makes `asset`, a .glb, of a bar `length` x 1 x 1 by `springlod convert` with `options`; the mesh
/// stays beside it.
void make_bar_asset(const std::filesystem::path& asset, double length,
                    const std::vector<std::string>& options);
/// A unit box without its lid.
std::string obj_of_open_box();

}  // namespace springlod::test
