// Short ways to write G-code in a test and to look at what was read.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "ribvault/error.hpp"
#include "ribvault/print/read_gcode.hpp"

namespace ribvault::test {

inline GcodePrint read(const std::string& text, const GcodeOptions& options = {}) {
    return read_gcode(text, "test.gcode", options);
}
inline GcodePrint corpus(const std::string& name) {
    return read_gcode(std::filesystem::path(RIBVAULT_CORPUS) / "gcode" / name);
}

/// What the error says; fails when there is none or it is not "unreadable".
inline std::string complaint(const std::string& text) {
    try {
        read(text);
    } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::unreadable);
        return e.what();
    }
    FAIL("no error");
    return {};
}

inline Rational x(const GcodePoint& p) { return to_rational(p.x); }
inline Rational y(const GcodePoint& p) { return to_rational(p.y); }
inline Rational decimal(const std::string& text) { return parse_rational(text, "test"); }

inline double length(const GcodeLayer& layer, const GcodeTrack& t) {
    return std::hypot(to_double(layer.points[t.b].x - layer.points[t.a].x),
                      to_double(layer.points[t.b].y - layer.points[t.a].y));
}
inline double length(const GcodeLayer& layer) {
    double sum = 0;
    for (const GcodeTrack& t : layer.tracks) sum += length(layer, t);
    return sum;
}
inline double length(const GcodePrint& print, const std::string& feature) {
    double sum = 0;
    for (const GcodeLayer& layer : print.layers)
        for (const GcodeTrack& t : layer.tracks)
            if (print.features[t.feature].name == feature) sum += length(layer, t);
    return sum;
}
inline const GcodeTrack& track(const GcodePrint& print, std::size_t layer, std::size_t index) {
    return print.layers.at(layer).tracks.at(index);
}
inline double width(const GcodeTrack& t) { return static_cast<double>(t.width) * 1e-9; }
inline double height(const GcodeLayer& l) { return static_cast<double>(l.height) * 1e-9; }
inline std::string name(const GcodePrint& print, const GcodeTrack& t) { return print.features.at(t.feature).name; }

}  // namespace ribvault::test
