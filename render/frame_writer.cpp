#include "render/frame_writer.hpp"

#include <utility>

namespace springlod::render {

FrameWriter::FrameWriter(Save save) : save_(std::move(save)), thread_([this] { work(); }) {}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameWriter::write(Image image, std::filesystem::path path) {
  std::unique_lock lock(mutex_);
  const std::size_t number = queued_;
  lock.unlock();
  write(std::move(image), std::move(path), number);
}

void FrameWriter::write(Image image, std::filesystem::path path, std::size_t number) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock,
                [&] { return failure_ || (queued_ == number && waiting_.size() < kMostWaiting); });
  rethrow();
  waiting_.push_back({std::move(image), std::move(path)});
  ++queued_;
  lock.unlock();
  changed_.notify_all();
}

void FrameWriter::abandon(std::exception_ptr failure) {
  {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }
  changed_.notify_all();
}

void FrameWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || (waiting_.empty() && !writing_); });
  rethrow();
}

void FrameWriter::rethrow() const {
  if (failure_) std::rethrow_exception(failure_);
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (stopping_) return;
    const Frame frame = std::move(waiting_.front());
    waiting_.pop_front();
    writing_ = true;
    lock.unlock();
    changed_.notify_all();
    std::exception_ptr failure;
    try {
      save_(frame.image, frame.path);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    writing_ = false;
    if (!failure_) failure_ = failure;
    changed_.notify_all();
    if (failure_) return;
  }
}

}  // namespace springlod::render
