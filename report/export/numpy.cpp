#include "report/export/numpy.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace springlod::report {
namespace {

// Format 1.0: magic, version, length of a Python literal that says type and shape, and that literal
// padded so that the values begin at a multiple of 64 bytes.
std::string npy_header(const std::string& type, const std::string& shape) {
  constexpr std::size_t kAligned = 64, kBefore = 10;
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
  const std::size_t unpadded = kBefore + text.size() + 1;
  text.append((kAligned - unpadded % kAligned) % kAligned, ' ');
  text += '\n';
  std::string header = "\x93NUMPY\x01";
  header += '\0';
  header += static_cast<char>(text.size() & 0xFFU);
  header += static_cast<char>(text.size() >> 8U);
  return header + text;
}

}  // namespace

void NumpyArrays::add_bytes(const std::string& name, char kind, const void* values,
                            std::size_t size, std::size_t count, std::size_t columns) {
  add_entry(
      name, fmt::format("{}{}{}", kind == 'S' || size == 1 ? '|' : '<', kind, size),
      columns == 0 ? fmt::format("{},", count) : fmt::format("{}, {}", count / columns, columns),
      count == 0 ? std::string_view()
                 : std::string_view(static_cast<const char*>(values), size * count));
}

void NumpyArrays::add_entry(const std::string& name, const std::string& type,
                            const std::string& shape, std::string_view values) {
  std::string content = npy_header(type, shape);
  content += values;
  entries_.push_back({name + ".npy", std::move(content)});
}

void NumpyArrays::add(const std::string& name, const std::vector<std::vector<Vec3>>& frames) {
  std::string values;
  for (const std::vector<Vec3>& points : frames)
    values.append(reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Vec3));
  const std::size_t points = frames.empty() ? 0 : frames.front().size();
  add_entry(name, "<f8", fmt::format("{}, {}, 3", frames.size(), points), values);
}

void NumpyArrays::add(const std::string& name, const std::vector<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  add_bytes(name, kind_of<double>(), points.data(), sizeof(double), 3 * points.size(), 3);
}

void NumpyArrays::add(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string padded;
  for (const std::string& text : texts) padded += text + std::string(width - text.size(), '\0');
  add_bytes(name, 'S', padded.data(), width, texts.size(), 0);
}

}  // namespace springlod::report
