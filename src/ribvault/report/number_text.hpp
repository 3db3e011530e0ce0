// Numbers and enclosures as text for people.
#pragma once

#include <string>

#include "ribvault/report/print_report.hpp"

namespace ribvault {

std::string fixed(double value, int places);

/// 1 layer, 2 layers
std::string many(long long count, const char* what);

/// Appends what printf would print, however long.
__attribute__((format(printf, 2, 3))) void append_formatted(std::string& text, const char* format, ...);

/// One number where both bounds print alike or differ by less than the last place, else both; an infinite one has no
/// material below.
std::string number_text(const Enclosure& e, int places);

}  // namespace ribvault
