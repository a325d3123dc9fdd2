#include "render/frame_writer.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "tests/render/golden.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::render;
using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

Image grey(std::uint8_t level) {
  return {8, 4, std::vector<std::uint8_t>(std::size_t{3} * 8 * 4, level)};
}

}  // namespace

TEST_CASE("images are written in order and equal those of save_png") {
  const TemporaryFolder folder;
  constexpr std::uint32_t kFrames = 20;
  FrameWriter writer;
  for (std::uint32_t k = 0; k < kFrames; ++k)
    writer.write(grey(static_cast<std::uint8_t>(k)), frame_path(folder.path(), k));
  writer.finish();
  save_png(grey(7), folder.path() / "alone.png");
  CHECK(read_file(frame_path(folder.path(), 7)) == read_file(folder.path() / "alone.png"));
  for (std::uint32_t k = 0; k < kFrames; ++k)
    CHECK(load_png(frame_path(folder.path(), k)).rgb == grey(static_cast<std::uint8_t>(k)).rgb);
  writer.write(grey(1), folder.path() / "more.png");  // it can be used after finish()
  writer.finish();
  CHECK(std::filesystem::exists(folder.path() / "more.png"));
}

TEST_CASE("an error on the writing thread reaches the caller, and nothing is written after it") {
  std::vector<std::string> written;
  FrameWriter writer([&](const Image&, const std::filesystem::path& path) {
    if (path == "2") throw IoError("no room for 2");
    written.push_back(path.string());
  });
  const auto write_all = [&] {
    for (int k = 0; k < 20; ++k) writer.write(grey(0), std::to_string(k));
    writer.finish();
  };
  CHECK_THROWS_AS(write_all(), IoError);
  CHECK_THROWS_WITH(writer.finish(), Contains("no room for 2"));  // again
  CHECK_THROWS_WITH(writer.write(grey(0), "21"), Contains("no room for 2"));
  CHECK(written == std::vector<std::string>{"0", "1"});
}

TEST_CASE("images of several threads are written in the order of their numbers") {
  std::vector<std::string> written;
  FrameWriter writer(
      [&](const Image&, const std::filesystem::path& path) { written.push_back(path.string()); });
  const auto draw = [&](std::size_t first) {
    for (std::size_t k = first; k < 20; k += 2) writer.write(grey(0), std::to_string(k), k);
  };
  std::thread odd(draw, 1);
  draw(0);
  odd.join();
  writer.finish();
  REQUIRE(written.size() == 20);
  for (std::size_t k = 0; k < 20; ++k) CHECK(written[k] == std::to_string(k));
}

TEST_CASE("a thread that waits for images that never come gets the error") {
  FrameWriter writer([](const Image&, const std::filesystem::path&) {});
  std::future<void> second = std::async(std::launch::async, [&] { writer.write(grey(0), "1", 1); });
  writer.abandon(std::make_exception_ptr(IoError("no image 0")));
  CHECK_THROWS_WITH(second.get(), Contains("no image 0"));
}

TEST_CASE("the queue is bounded") {
  std::promise<void> gate;
  const std::shared_future<void> open = gate.get_future().share();
  std::atomic<int> handed_over{0};
  std::atomic<int> most_ahead{0};
  int saved = 0;
  FrameWriter writer([&](const Image&, const std::filesystem::path&) {
    open.wait();
    ++saved;
    most_ahead = std::max(most_ahead.load(), handed_over - saved);
  });
  std::future<void> drawing = std::async(std::launch::async, [&] {
    for (int k = 0; k < 12; ++k) {
      writer.write(grey(0), "x");
      ++handed_over;
    }
  });
  constexpr int kMost = static_cast<int>(FrameWriter::kMostWaiting) + 1;  // one is being written
  while (handed_over < kMost) std::this_thread::yield();
  CHECK(handed_over == kMost);  // the next waits for the gate
  gate.set_value();
  drawing.get();
  writer.finish();
  CHECK(saved == 12);
  CHECK(most_ahead <= kMost);
}

TEST_CASE("destroying a writer finishes only the image being written") {
  std::atomic<int> saved{0};
  const auto give_up = [&] {
    FrameWriter writer([&](const Image&, const std::filesystem::path&) { ++saved; });
    for (int k = 0; k < 3; ++k) writer.write(grey(0), "x");
    throw InterruptedError();
  };
  CHECK_THROWS_AS(give_up(), InterruptedError);
  CHECK(saved <= 3);
}
