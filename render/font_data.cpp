#include "render/font_data.hpp"

// The assembler embeds the file, which needs neither generated source nor start-up time.
asm(R"(
.pushsection .rodata
.balign 16
springlod_font_begin:
.incbin ")" SPRINGLOD_FONT R"("
.byte 0
.popsection
)");

extern "C" {
extern const unsigned char springlod_font_begin[];  // NOLINT(readability-identifier-naming)
}

namespace springlod::render {

const unsigned char* font_file() {
  return springlod_font_begin;
}

}  // namespace springlod::render
