// How both reports write numbers. Include in .cpp files only.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "ribvault/verify/verdict.hpp"

namespace ribvault {

/// A measured length, area or volume, to 1e-6: below that it says nothing. null where it is not finite.
inline nlohmann::ordered_json measured(double value) {
    if (!std::isfinite(value)) return nullptr;
    const double rounded = std::round(value * 1e6) / 1e6;
    return rounded == 0 ? 0 : rounded;  // no -0
}

/// Bounds are not rounded: the statement is about these very numbers. null where they are not finite.
inline nlohmann::ordered_json bounds(const Enclosure& e) {
    const auto number = [](double v) {
        return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
    };
    return nlohmann::ordered_json::array({number(e.lo), number(e.hi)});
}

inline nlohmann::ordered_json stages(const StageCounts& c) {
    return {{"interval", c.interval}, {"rational", c.rational}, {"algebraic", c.algebraic}};
}

}  // namespace ribvault
