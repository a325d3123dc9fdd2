#pragma once

#include <cstddef>

namespace springlod::render {

/// DejaVu Sans as a TrueType file in memory, embedded at build time.
const unsigned char* font_file();
std::size_t font_file_size();

}  // namespace springlod::render
