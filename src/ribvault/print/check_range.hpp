// One message for settings that lie outside their range.
#pragma once

#include <cstdio>

#include "ribvault/error.hpp"

namespace ribvault {

/// Throws Error (usage) naming the setting and its range if the value is not within, or is no number.
inline void check_range(const char* name, double value, double least, double most) {
    if (value >= least && value <= most) return;
    char text[160];
    std::snprintf(text, sizeof text, "%s is %g; it must lie between %g and %g", name, value, least, most);
    throw Error(ErrorKind::usage, text);
}

}  // namespace ribvault
