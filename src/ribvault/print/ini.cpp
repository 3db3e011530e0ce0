#include "ribvault/print/ini.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "ribvault/error.hpp"

namespace ribvault {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

}  // namespace

std::vector<IniEntry> read_ini(std::string_view text, const std::string& name) {
    std::vector<IniEntry> entries;
    std::string section;
    int number = 0;
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    while (!text.empty()) {
        const auto end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
        ++number;
        if (line.empty() || line[0] == '#' || line[0] == ';') continue;
        const auto refuse = [&](const char* why) {
            throw Error(ErrorKind::usage,
                        name + ":" + std::to_string(number) + ": '" + std::string(line.substr(0, 60)) + "' " + why);
        };
        if (line[0] == '[') {
            if (line.back() != ']') refuse("is no section; it needs a ']' at its end");
            section = std::string(trimmed(line.substr(1, line.size() - 2)));
            continue;
        }
        const auto equals = line.find('=');
        if (equals == std::string_view::npos || equals == 0) refuse("is no setting; write 'key = value'");
        entries.push_back({section, std::string(trimmed(line.substr(0, equals))),
                           std::string(trimmed(line.substr(equals + 1))), number});
    }
    return entries;
}

double number_in(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw Error(ErrorKind::usage, "'" + std::string(text) + "' is not a number");
    return value;
}

int whole_number_in(std::string_view text) {
    const double value = number_in(text);
    if (value != std::floor(value) || std::fabs(value) > 1e6)
        throw Error(ErrorKind::usage, "'" + std::string(text) + "' is not a whole number of at most 1000000");
    return static_cast<int>(value);
}

std::vector<double> numbers_in(std::string_view text, std::size_t count, std::string_view example) {
    std::vector<double> values;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const std::string_view part = trimmed(text.substr(from, comma - from));
        if (part.empty()) break;
        values.push_back(number_in(part));
        from = comma + 1;
    }
    if (values.size() != count || text.ends_with(','))
        throw Error(ErrorKind::usage, "'" + std::string(text) + "' are not " + std::to_string(count) +
                                          " numbers; write for example " + std::string(example));
    return values;
}

std::string unescaped(std::string_view value) {
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
    std::string text;
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (value[i] != '\\' || i + 1 == value.size()) {
            text += value[i];
            continue;
        }
        switch (value[++i]) {
            case 'n': text += '\n'; break;
            case 't': text += '\t'; break;
            case 'r': break;
            case '"': text += '"'; break;
            case '\\': text += '\\'; break;
            default: text += '\\', text += value[i];
        }
    }
    return text;
}

}  // namespace ribvault
