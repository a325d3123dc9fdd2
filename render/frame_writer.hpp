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

/// Encodes and writes images, in order, on its own thread while the caller draws the next.
class FrameWriter {
 public:
  using Save = std::function<void(const Image&, const std::filesystem::path&)>;

  /// Capacity of the queue [images]: large enough that one slow image does not block the caller.
  static constexpr std::size_t kMostWaiting = 3;

  /// `save` is called on the writing thread.
  explicit FrameWriter(Save save = save_png);
  /// Drops images that are still queued; call finish() to write them.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Queues an image; blocks while the queue is full. Rethrows the error (IoError) of an earlier
  /// image; after an error no image is written.
  void write(Image image, std::filesystem::path path);
  /// The same for image `number` of several threads that draw: waits until those before it, from
  /// 0, are queued, so that images are written in order.
  void write(Image image, std::filesystem::path path, std::size_t number);
  /// No further image comes: threads that wait in write() throw this error.
  void abandon(std::exception_ptr failure);
  /// Blocks until all images are written. Throws as write() does.
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
  std::condition_variable changed_;  // signals a change of any member below
  std::deque<Frame> waiting_;
  std::size_t queued_ = 0;  // images so far
  bool writing_ = false;    // an image taken from the queue is being written
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses all members above
};

}  // namespace springlod::render
