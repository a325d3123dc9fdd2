#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <xxhash.h>

namespace springlod::sim {

/// Gives equal entries the same number. An entry must have no padding bytes.
template <class Entry>
class Palette {
 public:
  /// `entries` receives each entry once.
  explicit Palette(std::vector<Entry>& entries) : entries_(&entries) {}
  std::uint32_t number(const Entry& entry) {
    auto& same_hash = numbers_[XXH3_64bits(&entry, sizeof entry)];
    for (const std::uint32_t n : same_hash)
      if ((*entries_)[n] == entry) return n;
    same_hash.push_back(static_cast<std::uint32_t>(entries_->size()));
    entries_->push_back(entry);
    return same_hash.back();
  }

 private:
  std::vector<Entry>* entries_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> numbers_;
};

}  // namespace springlod::sim
