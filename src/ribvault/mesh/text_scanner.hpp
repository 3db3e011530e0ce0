// Tokens and numbers of text formats, with the line for complaints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ribvault/mesh/input_file.hpp"

namespace ribvault {

/// The nearest double to a decimal number, or nothing when the text is not one number from end to end. "nan", "inf" and
/// what exceeds the doubles are numbers here and come back not finite, so that they get a message of their own.
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Line, from 1, of a byte of a text.
std::size_t line_number(const InputFile& file, std::size_t position);

/// Walks through a text. Lines end with LF, CR LF or CR; everything from `comment` to the end of the line is skipped.
class TextScanner {
public:
    TextScanner(const InputFile& file, std::size_t start, char comment);

    /// Skips blanks, line ends and comments; true when nothing is left.
    bool at_end();
    /// Skips blanks and a comment; true when nothing is left on this line.
    bool at_line_end();
    /// Goes to the start of the next line.
    void next_line();

    /// Next token, over line ends; `expected` says what for when there is none (Error, unreadable: the file is
    /// truncated).
    std::string_view token(const char* expected);
    std::int64_t integer(const char* expected);
    double number(const char* expected);
    /// A number that must be finite; otherwise Error (bad_geometry).
    double coordinate();

    /// How many bytes are left.
    std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
    std::size_t position() const { return static_cast<std::size_t>(at_ - file_->data.data()); }
    /// Throws Error (unreadable) naming the current line.
    [[noreturn]] void fail(const std::string& what, const std::string& remedy = "export the mesh again") const;

private:
    const InputFile* file_;
    const char* at_;
    const char* end_;
    char comment_;
};

}  // namespace ribvault
