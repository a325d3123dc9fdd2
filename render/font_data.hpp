#pragma once

namespace springlod::render {

/// DejaVu Sans as a TrueType file in memory, embedded at build time.
const unsigned char* font_file();

}  // namespace springlod::render
