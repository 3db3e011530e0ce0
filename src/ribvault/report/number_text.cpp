#include "ribvault/report/number_text.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace ribvault {

std::string fixed(double value, int places) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", places, value);
    return text;
}

std::string many(long long count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void append_formatted(std::string& text, const char* format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int count = std::vsnprintf(nullptr, 0, format, arguments);
    va_end(arguments);
    if (count > 0) {
        const std::size_t before = text.size();
        text.resize(before + static_cast<std::size_t>(count) + 1);
        std::vsnprintf(text.data() + before, static_cast<std::size_t>(count) + 1, format, again);
        text.pop_back();
    }
    va_end(again);
}

std::string number_text(const Enclosure& e, int places) {
    if (!std::isfinite(e.hi)) return "no material below";
    const double last_place = std::pow(10, -places);
    if (e.lo > 0 && e.hi < 0.5 * last_place) return "< " + fixed(last_place, places);
    if (e.hi - e.lo < last_place) return fixed(e.middle(), places);
    return fixed(e.lo, places) + " to " + fixed(e.hi, places);
}

}  // namespace ribvault
