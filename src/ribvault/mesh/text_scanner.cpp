#include "ribvault/mesh/text_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace ribvault {
namespace {

bool is_newline(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view without_plus(std::string_view text) {
    return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

/// For messages: at most 30 characters, none of them unprintable.
std::string quoted(std::string_view text) {
    std::string shown(text.substr(0, 30));
    std::replace_if(shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + shown + (text.size() > 30 ? "...'" : "'");
}

}  // namespace

std::optional<double> parse_double(std::string_view text) {
    text = without_plus(text);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        const std::size_t exponent = text.find_first_of("eE");
        const bool tiny = exponent == std::string_view::npos ? text.find('.') <= 2 : text[exponent + 1] == '-';
        return tiny ? 0 : std::numeric_limits<double>::infinity();
    }
    return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
    text = without_plus(text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error != std::errc()) return std::nullopt;
    return value;
}

std::size_t line_number(const InputFile& file, std::size_t position) {
    const std::string& data = file.data;
    std::size_t count = 1;
    for (std::size_t i = 0; i < position; ++i)
        count += data[i] == '\n' || (data[i] == '\r' && !(i + 1 < data.size() && data[i + 1] == '\n'));
    return count;
}

TextScanner::TextScanner(const InputFile& file, std::size_t start, char comment)
    : file_(&file), at_(file.data.data() + start), end_(file.data.data() + file.data.size()), comment_(comment) {}

bool TextScanner::at_line_end() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    if (at_ != end_ && *at_ == comment_)
        while (at_ != end_ && !is_newline(*at_)) ++at_;
    return at_ == end_ || is_newline(*at_);
}

bool TextScanner::at_end() {
    while (at_line_end() && at_ != end_) ++at_;
    return at_ == end_;
}

void TextScanner::next_line() {
    while (at_ != end_ && !is_newline(*at_)) ++at_;
    if (at_ != end_ && *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    if (at_ != end_) ++at_;
}

std::string_view TextScanner::token(const char* expected) {
    if (at_end())
        fail(std::string("the file ends where ") + expected + " should follow",
             "it is incomplete, copy or export it again");
    const char* const start = at_;
    while (at_ != end_ && !is_blank(*at_) && !is_newline(*at_) && *at_ != comment_) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
}

std::int64_t TextScanner::integer(const char* expected) {
    const std::string_view text = token(expected);
    const auto value = parse_integer(text);
    if (!value) fail(quoted(text) + " stands where " + expected + " should");
    return *value;
}

double TextScanner::number(const char* expected) {
    const std::string_view text = token(expected);
    const auto value = parse_double(text);
    if (!value) fail(quoted(text) + " stands where " + expected + " should");
    return *value;
}

double TextScanner::coordinate() {
    const std::string_view text = token("a coordinate");
    const auto value = parse_double(text);
    if (!value) fail(quoted(text) + " stands where a coordinate should");
    if (!std::isfinite(*value))
        file_->fail(ErrorKind::bad_geometry, "line " + std::to_string(line_number(*file_, position())),
                   "the coordinate " + quoted(text) + " is not a finite number", "repair the mesh where it was made");
    return *value;
}

void TextScanner::fail(const std::string& what, const std::string& remedy) const {
    file_->fail(ErrorKind::unreadable, "line " + std::to_string(line_number(*file_, position())), what, remedy);
}

}  // namespace ribvault
