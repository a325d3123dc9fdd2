#pragma once

#include <string>

#include "sim/study/no_contact.hpp"

namespace springlod::report {

/// One sentence: that the body touches nothing, how near it comes to an obstacle, and what to
/// change: "the body touches nothing within 600 ms: it comes no nearer than 13.1 m to the floor (at
/// 600 ms), so errors are those of free motion; change throw.position, in metres, or the duration".
std::string no_contact_text(const sim::NoContact& found);

}  // namespace springlod::report
