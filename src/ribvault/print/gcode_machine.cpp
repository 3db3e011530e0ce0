#include "ribvault/print/gcode_machine.hpp"

namespace ribvault {
namespace {

constexpr char axis_letters[] = {'X', 'Y', 'Z'};
constexpr Int128 farthest = static_cast<Int128>(decimal_limit) * decimal_one;

bool too_far(Decimal d) { return d.value > farthest || d.value < -farthest; }

}  // namespace

std::string GcodeMachine::read_length(const GcodeWords& w, char letter, Decimal& length) const {
    length = w[letter];
    if (!inches_) return {};
    const std::optional<Decimal> mm = inches(length);
    if (!mm) return std::string("the number of ") + letter + " has more than 17 decimals (inches)";
    length = *mm;
    return {};
}

std::string GcodeMachine::find_centre(const GcodeWords& w, GcodeMotion& motion) const {
    if (plane_ != 17) return "an arc outside the plane of the bed (G18, G19); expected G17 before it";
    if (w.has('R')) {
        if (std::string wrong = read_length(w, 'R', motion.radius); !wrong.empty()) return wrong;
        if (motion.radius.value == 0) return "an arc of radius 0; expected R other than 0";
        if (!motion.moves_flat()) return "a full circle by its radius; expected I and J";
        return {};
    }
    if (!w.has('I') && !w.has('J')) return "an arc without centre; expected I and J, or R";
    motion.radius = {};
    for (std::size_t k = 0; k < 2; ++k) {
        const char letter = k == 0 ? 'I' : 'J';
        Decimal given;
        if (w.has(letter))
            if (std::string wrong = read_length(w, letter, given); !wrong.empty()) return wrong;
        motion.centre[k] = absolute_centres_ ? given + offset_[k] : motion.from[k] + given;
    }
    return {};
}

std::string GcodeMachine::move(const GcodeWords& w, GcodeMotion& motion) {
    std::array<Decimal, 3> to = at_;
    for (std::size_t k = 0; k < 3; ++k) {
        motion.from[k] = at_[k] + offset_[k];
        if (w.has(axis_letters[k])) {
            Decimal given;
            if (std::string wrong = read_length(w, axis_letters[k], given); !wrong.empty()) return wrong;
            to[k] = relative_ ? at_[k] + given : given;
        }
        motion.to[k] = to[k] + offset_[k];
        if (too_far(motion.to[k]))
            return std::string(1, axis_letters[k]) + " goes 10 km from the origin, beyond any printer";
    }
    motion.pushed = 0;
    Decimal& e = pushed_[static_cast<std::size_t>(tool_)];
    Decimal new_e = e;
    motion.volumetric = volumetric_[static_cast<std::size_t>(tool_)];
    if (w.has('E')) {
        Decimal given;
        if (std::string wrong = read_length(w, 'E', given); !wrong.empty()) return wrong;
        new_e = relative_ || relative_e_ ? e + given : given;
        motion.pushed = to_double(new_e - e);
        if (inches_ && motion.volumetric) motion.pushed *= 25.4 * 25.4;
        if (too_far(new_e)) return "E goes beyond 10 km of filament";
    }
    motion.tool = tool_;
    motion.kind = GcodeMotion::Kind::line;
    if (w.code >= 2) {
        motion.kind = w.code == 2 ? GcodeMotion::Kind::clockwise : GcodeMotion::Kind::counter_clockwise;
        if (std::string wrong = find_centre(w, motion); !wrong.empty()) return wrong;
    } else if (!motion.moves_flat() && !motion.moves_up() && motion.pushed == 0) {
        motion.kind = GcodeMotion::Kind::none;
    }
    at_ = to;
    e = new_e;
    return {};
}

std::string GcodeMachine::set_position(const GcodeWords& w) {
    const bool all = w.written == 0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (w.subcode == 1) {  // G92.1 takes the offsets back
            at_[k] = at_[k] + offset_[k];
            offset_[k] = {};
        } else if (all || w.has(axis_letters[k])) {
            Decimal given;
            if (!all)
                if (std::string wrong = read_length(w, axis_letters[k], given); !wrong.empty()) return wrong;
            offset_[k] = offset_[k] + at_[k] - given;
            at_[k] = given;
            if (too_far(offset_[k])) return std::string("G92 puts the origin of ") + axis_letters[k] + " 10 km away";
        }
    }
    if (w.subcode != 1 && (all || w.has('E'))) {
        Decimal given;
        if (!all)
            if (std::string wrong = read_length(w, 'E', given); !wrong.empty()) return wrong;
        pushed_[static_cast<std::size_t>(tool_)] = given;
    }
    return {};
}

void GcodeMachine::home(const GcodeWords& w) {
    const bool all = !w.has('X') && !w.has('Y') && !w.has('Z');
    for (std::size_t k = 0; k < 3; ++k)
        if (all || w.has(axis_letters[k])) at_[k] = offset_[k] = {};
}

std::string GcodeMachine::apply(const GcodeWords& w, GcodeMotion& motion) {
    motion.kind = GcodeMotion::Kind::none;
    if (w.letter == 'T') {
        if (w.code < tools) tool_ = w.code;  // beyond: T255 and T1000 are messages to Bambu's firmware
        return {};
    }
    if (w.letter == 'M') {
        if (w.code == 82) relative_e_ = false;
        if (w.code == 83) relative_e_ = true;
        if (w.code == 200) {
            const std::size_t which = w.has('T') && w['T'].value >= 0 && w['T'].value < Int128{tools} * decimal_one
                                          ? static_cast<std::size_t>(w['T'].value / decimal_one)
                                          : static_cast<std::size_t>(tool_);
            if (w.has('D')) volumetric_[which] = w['D'].value > 0;
            if (w.has('S')) volumetric_[which] = w['S'].value != 0;
        }
        return {};
    }
    if (w.letter != 'G') return {};
    switch (w.code) {
        case 0: case 1: case 2: case 3: return move(w, motion);
        case 5: return "a spline (G5); expected straight moves and arcs, G0 to G3";
        case 17: case 18: case 19: plane_ = w.code; return {};
        case 20: inches_ = true; return {};
        case 21: inches_ = false; return {};
        case 28: home(w); return {};
        case 90:
            (w.subcode == 1 ? absolute_centres_ : relative_) = w.subcode == 1;
            return {};
        case 91:
            if (w.subcode == 1)
                absolute_centres_ = false;
            else
                relative_ = true;
            return {};
        case 92: return set_position(w);
        default: return {};
    }
}

}  // namespace ribvault
