// One line of G-code as words: a letter and a number each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ribvault/print/decimal.hpp"

namespace ribvault {

/// "G1 X1.5 E.2 ; comment" as command G 1 with words X and E. Views point into the line.
struct GcodeWords {
    char letter = 0;  ///< of the command: G, M or T; 0: none, or one that no slicer writes for motion
    int code = -1;
    int subcode = 0;              ///< the 1 of G92.1
    std::uint32_t written = 0;    ///< bit k: letter 'A' + k stands in the line
    std::uint32_t bare = 0;       ///< bit k: it has no number
    Decimal values[26];           ///< where written and not bare
    std::string_view comment;     ///< after the semicolon, without it

    static constexpr std::uint32_t bit(char c) { return std::uint32_t{1} << (c - 'A'); }
    bool has(char c) const { return (written & bit(c)) != 0; }
    Decimal operator[](char c) const { return values[c - 'A']; }
};

/// What is wrong with a line, or empty.
///
/// Letters may be small, blanks between words are optional, "N12" before and "*71" after the command and remarks in
/// parentheses are skipped. The words of G0 to G3 and of every other command in `strict` must be letter and number;
/// other commands (M117 Hello, START_PRINT A=1) are not looked into unless they are M82, M83, M200 or T.
/// Precondition: no line feed in `line`.
std::string scan_line(std::string_view line, GcodeWords& words);

/// For messages: at most 30 characters in quotes, unprintable ones as '?'.
std::string quoted_text(std::string_view text);

}  // namespace ribvault
