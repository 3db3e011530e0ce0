// Numbers and enclosures as text for people.
#pragma once

#include <string>

#include "ribvault/report/print_report.hpp"

namespace ribvault {

std::string fixed(double value, int places);

/// One number where both bounds print alike or differ by less than the last place, else both; an infinite one has no
/// material below.
std::string number_text(const Enclosure& e, int places);

}  // namespace ribvault
