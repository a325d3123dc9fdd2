#pragma once

#include <string>
#include <string_view>

namespace springlod::inline base {

/// Bytes as base64 (RFC 4648, section 4), padded with '=', without line breaks: 4 characters for
/// each 3 bytes.
std::string base64(std::string_view bytes);

}  // namespace springlod::inline base
