// Lines of the form `key = value`, with sections, as printer profiles and PrusaSlicer's bundles have them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ribvault {

struct IniEntry {
    std::string section;  ///< of the last `[section]` above; empty before the first
    std::string key, value;
    int line = 0;  ///< from 1
};

/// All entries of a text in its order. Lines that are empty or begin with `#` or `;` are comments; blanks around key
/// and value do not count. `name`: what to call the text in errors. Throws Error (usage) with name and line number for
/// a line that is none of these.
std::vector<IniEntry> read_ini(std::string_view text, const std::string& name);

/// The text as a number, a whole number of at most a million. Throws Error (usage) that quotes it when it is none.
double number_in(std::string_view text);
int whole_number_in(std::string_view text);

/// So many numbers between commas; blanks around them do not count. Throws Error (usage) that quotes the text and gives
/// the example when it is none.
std::vector<double> numbers_in(std::string_view text, std::size_t count, std::string_view example);

/// `\n`, `\t`, `\"` and `\\` as the characters they stand for; outer quotes taken off.
std::string unescaped(std::string_view value);

}  // namespace ribvault
