// The printer's modal state: what a line of G-code moves, and how much it pushes.
#pragma once

#include <array>
#include <string>

#include "ribvault/print/gcode_words.hpp"

namespace ribvault {

/// One move in mm on the bed, exactly as the file says.
struct GcodeMotion {
    enum class Kind { none, line, clockwise, counter_clockwise } kind = Kind::none;
    std::array<Decimal, 3> from, to;  ///< x, y, z
    std::array<Decimal, 2> centre;    ///< of an arc, where I and J say so
    Decimal radius;                   ///< of an arc by R: not 0; negative: the longer way round
    double pushed = 0;                ///< mm of filament, or mm³ if volumetric; negative: retracted
    bool volumetric = false;
    int tool = 0;
    bool moves_flat() const { return from[0] != to[0] || from[1] != to[1]; }
    bool moves_up() const { return from[2] != to[2]; }
};

/// G0 to G3, G17 to G21, G28, G90 to G92, M82, M83, M200 and T. X, Y, Z and E are absolute until G91 and M83 say
/// otherwise; under G91 E is relative too, and G90 does not undo M83 (as PrusaSlicer, Klipper and Prusa's firmware have
/// it). Every tool has its own E. G28 puts its axes at 0.
class GcodeMachine {
public:
    static constexpr int tools = 64;

    /// Obeys one line. What is wrong with it, or empty; `motion.kind` is none when nothing moves and nothing is pushed.
    std::string apply(const GcodeWords& words, GcodeMotion& motion);

    /// Does the file count in inches at present (G20)?
    bool in_inches() const { return inches_; }

private:
    std::string move(const GcodeWords& w, GcodeMotion& motion);
    std::string find_centre(const GcodeWords& w, GcodeMotion& motion) const;
    std::string read_length(const GcodeWords& w, char letter, Decimal& length) const;
    std::string set_position(const GcodeWords& w);
    void home(const GcodeWords& w);

    std::array<Decimal, 3> at_{}, offset_{};  ///< logical; bed = logical + offset
    std::array<Decimal, tools> pushed_{};     ///< E, logical
    std::array<bool, tools> volumetric_{};
    int tool_ = 0;
    int plane_ = 17;
    bool relative_ = false, relative_e_ = false, inches_ = false, absolute_centres_ = false;
};

}  // namespace ribvault
