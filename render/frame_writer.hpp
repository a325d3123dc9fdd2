#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include "render/frames.hpp"

namespace springlod::render {

/// Encodes and writes pictures, in order, on a thread of its own while the caller draws the next.
class FrameWriter {
 public:
  using Save = std::function<void(const Image&, const std::filesystem::path&)>;

  /// At most this many pictures wait: enough that a slow one stops nobody, few megabytes.
  static constexpr std::size_t kMostWaiting = 3;

  /// `save` is called on the other thread.
  explicit FrameWriter(Save save = save_png);
  /// Pictures still waiting are dropped: finish() is what waits for them.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Hands a picture over; while the queue is full, waits. Throws what stopped the writing of an
  /// earlier picture (IoError); no later one is written.
  void write(Image image, std::filesystem::path path);
  /// Waits until every picture is written. Throws as write() does.
  void finish();

 private:
  struct Frame {
    Image image;
    std::filesystem::path path;
  };

  void work();
  void rethrow() const;

  Save save_;
  std::mutex mutex_;
  std::condition_variable changed_;  // anything below did
  std::deque<Frame> waiting_;
  bool writing_ = false;  // a picture that waits no more
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace springlod::render
