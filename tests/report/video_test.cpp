#include "report/video.hpp"

#include <csignal>
#include <fstream>

#include <catch2/catch.hpp>
#include <sys/resource.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/subprocess.hpp"
#include "render/frames.hpp"
#include "tests/render/golden.hpp"
#include "tests/report/programs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

namespace {

void write_frames(const std::filesystem::path& folder, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) {
    render::Image image{33, 21, std::vector<std::uint8_t>(std::size_t{33} * 21 * 3, 200)};
    for (std::uint32_t x = 0; x < 3 * 10; ++x) image.rgb[k * 99 + x] = 20;
    render::save_png(image, render::frame_path(folder, k));
  }
}

}  // namespace

TEST_CASE("frames are encoded as mp4 and gif, also with odd sides and unusual folder names") {
  if (!find_program("ffmpeg")) {
    WARN("ffmpeg is not installed: not tested");
    return;
  }
  const TemporaryFolder folder;
  const auto frames = folder.path() / "100%d it's";
  write_frames(frames, 6);
  for (const char* name : {"a.mp4", "a.gif"}) {
    const auto path = folder.path() / name;
    const VideoResult result = encode_video(frames, 30, path);
    CHECK(result.made);
    const std::string bytes = read_file(path);
    CHECK(bytes.size() > 100);
    if (path.extension() == ".gif")
      CHECK(bytes.substr(0, 3) == "GIF");
    else
      CHECK(bytes.substr(4, 4) == "ftyp");
    // The command can be pasted into a shell and makes the same video.
    std::filesystem::remove(path);
    REQUIRE(std::system(result.command.c_str()) == 0);
    CHECK(read_file(path) == bytes);
  }
}

TEST_CASE("without ffmpeg the frames are kept and the command is reported") {
  const TemporaryFolder folder;
  write_frames(folder.path(), 2);
  const PathIs nothing("");
  const VideoResult result = encode_video(folder.path(), 25, folder.path() / "a.mp4");
  CHECK_FALSE(result.made);
  CHECK(result.command.starts_with("ffmpeg "));
  CHECK(result.command.find("-framerate 25") != std::string::npos);
  CHECK(result.command.find((folder.path() / "frame_%04d.png").string()) != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "a.mp4"));
}

namespace {

/// While it lives, no file of this process and its children grows beyond some bytes.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &former_);
    const rlimit limit{bytes, former_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &former_);
    std::signal(SIGXFSZ, SIG_DFL);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit former_{};
};

}  // namespace

TEST_CASE("a video that does not fit on the disk is refused, and the old one stays") {
  if (!find_program("ffmpeg")) return;
  const TemporaryFolder folder;
  write_frames(folder.path(), 6);
  for (const char* name : {"a.mp4", "a.gif"}) {
    write_text_file(folder / name, "old");
    const SmallFiles limit(100);
    CHECK_THROWS_WITH(encode_video(folder.path(), 30, folder / name), Catch::Contains(name));
    CHECK(read_file(folder / name) == "old");
  }
}

TEST_CASE("a video that cannot be made is refused with a reason") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(encode_video(folder.path(), 30, folder.path() / "a.mp4"),
                    Catch::Contains("draw the frames first"));
  write_frames(folder.path(), 1);
  CHECK_THROWS_WITH(encode_video(folder.path(), 30, folder.path() / "a.avi"),
                    Catch::Contains(".mp4 or .gif"));
  CHECK_THROWS_AS(encode_video(folder.path(), 0, folder.path() / "a.mp4"), InputError);
  if (!find_program("ffmpeg")) return;
  std::ofstream(render::frame_path(folder.path(), 0)) << "no picture";
  CHECK_THROWS_AS(encode_video(folder.path(), 30, folder.path() / "a.mp4"), IoError);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "a.mp4"));
}

TEST_CASE("programs receive their arguments unchanged, and their errors are returned") {
  const ProgramResult result =
      run_program("/bin/sh", {"-c", "printf %s \"$1\" >&2; exit 7", "x", "a 'b' $HOME"});
  CHECK(result.exit_code == 7);
  CHECK(result.errors == "a 'b' $HOME");
  CHECK(run_program("/bin/sh", {"-c", "kill -9 $$"}).exit_code == 137);
  CHECK_THROWS_AS(run_program("/no/such/program", {}), IoError);
}

TEST_CASE("words for a shell are quoted where needed") {
  CHECK(shell_word("frame_%04d.png") == "frame_%04d.png");
  CHECK(shell_word("a b") == "'a b'");
  CHECK(shell_word("it's") == "'it'\\''s'");
  CHECK(shell_word("") == "''");
  CHECK(shell_line("gnuplot", {"-e", "x=1;"}) == "gnuplot -e 'x=1;'");
}
