#include "ribvault/print/gcode_words.hpp"

#include <algorithm>
#include <array>

namespace ribvault {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
bool is_letter(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Skips blanks and remarks in parentheses.
void skip_blanks(std::string_view& text) {
    for (;;) {
        std::size_t n = 0;
        while (n < text.size() && is_blank(text[n])) ++n;
        text.remove_prefix(n);
        if (text.empty() || text.front() != '(') return;
        const std::size_t close = text.find(')');
        text.remove_prefix(close == std::string_view::npos ? text.size() : close + 1);
    }
}

int scan_code(std::string_view& text) {
    int code = 0;
    std::size_t n = 0;
    for (; n < text.size() && is_digit(text[n]); ++n) code = std::min(code * 10 + (text[n] - '0'), 100000);
    text.remove_prefix(n);
    return n == 0 ? -1 : code;
}

/// Does the command change what moves mean?
bool is_obeyed(char letter, int code) {
    if (letter == 'G')
        return (code >= 0 && code <= 3) || code == 20 || code == 21 || code == 28 || (code >= 90 && code <= 92);
    return letter == 'M' && (code == 82 || code == 83 || code == 200);
}

constexpr const char* second_command = "a second command on the line; expected each on a line of its own";

/// Commands without words of their own, which another command may follow on a line.
bool is_mode(const GcodeWords& w) {
    if (w.letter == 'M') return w.code == 82 || w.code == 83;
    return w.letter == 'T' || (w.code >= 17 && w.code <= 21) || (w.code >= 53 && w.code <= 59) || w.code == 90 ||
           w.code == 91;
}

bool begins_with_obeyed(std::string_view text) {
    skip_blanks(text);
    if (text.empty()) return false;
    const char letter = upper(text.front());
    text.remove_prefix(1);
    return is_obeyed(letter, scan_code(text));
}

/// Does one of the words that follow begin a command that is obeyed?
bool holds_obeyed(std::string_view text) {
    for (std::size_t n = 0; n < text.size(); ++n)
        if ((n == 0 || !is_letter(upper(text[n - 1]))) && begins_with_obeyed(text.substr(n))) return true;
    return false;
}

/// Commands whose words are numbers, none of which is read: after these words another command may follow. Others have
/// text behind them (M117).
bool has_numbers(const GcodeWords& w) {
    if (w.letter == 'G') return w.code == 4 || w.code == 10 || w.code == 11;
    constexpr std::array<int, 24> codes{18,  84,  73,  74,  104, 105, 106, 107, 108, 109, 140, 141,
                                        190, 191, 201, 203, 204, 205, 220, 221, 400, 572, 593, 900};
    return w.letter == 'M' && std::find(codes.begin(), codes.end(), w.code) != codes.end();
}

/// X10, X 10 or X10Y5, but not X10_HOME.
bool begins_with_coordinate(std::string_view text) {
    if (std::string_view("XYZEF").find(upper(text.front())) == std::string_view::npos) return false;
    text.remove_prefix(1);
    skip_blanks(text);
    const std::size_t length = scan_decimal(text).length;
    if (length == 0) return false;
    text.remove_prefix(length);
    if (text.empty() || is_blank(text.front()) || text.front() == '*' || text.front() == '(') return true;
    return is_letter(upper(text.front())) && scan_decimal(text.substr(1)).length > 0;
}

/// Whether the words after the command are numbers that decide where material goes.
bool is_read(const GcodeWords& w) {
    if (w.letter == 'G') return w.code <= 3 || w.code == 28 || w.code == 92;
    return w.letter == 'M' && w.code == 200;
}

std::string scan_words(std::string_view text, GcodeWords& w) {
    const bool flags = w.letter == 'G' && w.code == 28;  // "G28 X": a letter alone
    for (skip_blanks(text); !text.empty() && text.front() != '*'; skip_blanks(text)) {
        const char letter = upper(text.front());
        if (!is_letter(letter)) return quoted_text(text) + " stands where a letter such as X, Y, Z, E or F should";
        text.remove_prefix(1);
        while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
        if (std::string_view code = text; is_obeyed(letter, scan_code(code))) return second_command;
        const std::uint32_t bit = GcodeWords::bit(letter);
        if ((w.written & bit) != 0) return std::string("the word ") + letter + " stands there twice";
        w.written |= bit;
        const ScannedDecimal number = scan_decimal(text);
        switch (number.fault) {
            case ScannedDecimal::Fault::none: break;
            case ScannedDecimal::Fault::no_number:
                if (!flags)
                    return (text.empty() ? "the line ends" : quoted_text(text) + " stands") + " where the number of " +
                           letter + " should";
                w.bare |= bit;
                break;
            case ScannedDecimal::Fault::too_many_decimals:
                return std::string("the number of ") + letter + " has more than 18 decimals";
            case ScannedDecimal::Fault::too_large:
                return std::string("the number of ") + letter + " is 10000000 or more, no length of a print";
        }
        w.values[letter - 'A'] = number.number;
        text.remove_prefix(number.length);
    }
    return {};
}

}  // namespace

std::string quoted_text(std::string_view text) {
    std::string shown(text.substr(0, 30));
    std::replace_if(shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + shown + (text.size() > 30 ? "...'" : "'");
}

std::string scan_line(std::string_view line, GcodeWords& w) {
    w.letter = 0, w.code = -1, w.subcode = 0, w.written = 0, w.bare = 0;
    const std::size_t semicolon = line.find(';');
    w.comment = semicolon == std::string_view::npos ? std::string_view{} : line.substr(semicolon + 1);
    std::string_view text = line.substr(0, semicolon);
    // "(a; b) G1 X1": whether the remark ends at the bracket or at the end of the line, printers see differently.
    if (const std::size_t close = w.comment.find(')');
        close != std::string_view::npos && text.rfind('(') != std::string_view::npos &&
        text.find(')', text.rfind('(')) == std::string_view::npos && begins_with_obeyed(w.comment.substr(close + 1)))
        return "a semicolon in a remark in parentheses, and a command behind it; expected one or the other";
    skip_blanks(text);
    if (text.empty()) return {};
    if (upper(text.front()) == 'N') {  // line number
        std::string_view after = text.substr(1);
        skip_blanks(after);
        if (scan_code(after) >= 0) {
            text = after;
            skip_blanks(text);
            if (text.empty()) return {};
        }
    }
    const char letter = upper(text.front());
    // A byte that is no letter, or a remark that a semicolon ends: some printers print what follows, others do not.
    if (!is_letter(letter) && holds_obeyed(text.substr(1)))
        return quoted_text(text) + " has a command that does not begin the line; expected each on a line of its own";
    if (begins_with_coordinate(text))
        return quoted_text(text) + " moves without a command; expected G0 to G3 before it on each line";
    if (letter != 'G' && letter != 'M' && letter != 'T') return {};
    std::string_view rest = text.substr(1);
    skip_blanks(rest);
    w.code = scan_code(rest);
    if (w.code < 0) return {};  // a macro: GREETING, M_FOO
    w.letter = letter;
    if (!rest.empty() && rest.front() == '.') {
        rest.remove_prefix(1);
        w.subcode = std::max(0, scan_code(rest));
    }
    if (is_mode(w) && begins_with_obeyed(rest)) return second_command;
    if (!is_read(w) && has_numbers(w) && holds_obeyed(rest)) return second_command;
    return is_read(w) ? scan_words(rest, w) : std::string{};
}

}  // namespace ribvault
