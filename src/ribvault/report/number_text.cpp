#include "ribvault/report/number_text.hpp"

#include <cmath>
#include <cstdio>

namespace ribvault {

std::string fixed(double value, int places) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", places, value);
    return text;
}

std::string number_text(const Enclosure& e, int places) {
    if (!std::isfinite(e.hi)) return "no material below";
    const double last_place = std::pow(10, -places);
    if (e.lo > 0 && e.hi < 0.5 * last_place) return "< " + fixed(last_place, places);
    if (e.hi - e.lo < last_place) return fixed(e.middle(), places);
    return fixed(e.lo, places) + " to " + fixed(e.hi, places);
}

}  // namespace ribvault
