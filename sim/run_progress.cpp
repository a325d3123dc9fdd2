#include "sim/run_progress.hpp"

#include "model/error.hpp"

namespace springlod {

void RunProgress::begin(std::string_view /*task*/, std::uint64_t total) {
  total_ = total;
}

void RunProgress::advance(std::uint64_t count) {
  if ((*stopped_)()) throw InterruptedError();
  done_ += count;
  report(kUnits * done_ / total_);
}

void RunProgress::report(std::uint64_t units) {
  if (whole_ != nullptr && units > reported_) whole_->advance(units - reported_);
  reported_ = units;
}

}  // namespace springlod
