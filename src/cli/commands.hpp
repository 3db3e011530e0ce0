// One function a subcommand: adds it to the program's parser; the returned function runs it and returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <climits>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "ribvault/error.hpp"
#include "ribvault/exact/rational.hpp"

namespace ribvault::cli {

std::function<int()> add_generate(CLI::App& app);
std::function<int()> add_verify(CLI::App& app);
std::function<int()> add_page(CLI::App& app);

/// An option that names an output. An empty name, which a script writes whose variable is not set, is refused.
inline CLI::Option* add_output(CLI::App* command, const std::string& option, std::string& target,
                               const std::string& help, const std::string& type = "FILE") {
    const CLI::Validator named(
        [](const std::string& name) { return std::string(name.empty() ? "the name of the output is empty" : ""); }, "");
    return command->add_option(option, target, help)->check(named)->type_name(type);
}

/// Where a number in the text begins that may have a + before it.
inline const char* after_plus(const std::string& text) {
    return text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
}

/// A whole number, decimal (a leading 0 does not make it octal). Throws Error (usage) naming the option.
inline int whole_in(const std::string& text, const std::string& option, int least = INT_MIN, int most = INT_MAX) {
    int value = 0;
    const auto [end, error] = std::from_chars(after_plus(text), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument)
        throw Error(ErrorKind::usage, option + ": '" + text + "' is no whole number");
    if (error == std::errc::result_out_of_range)
        throw Error(ErrorKind::usage, option + ": '" + text + "' is far too large or too small");
    if (value < least || value > most)
        throw Error(ErrorKind::usage, option + " is " + text + "; it must lie between " + std::to_string(least) +
                                          " and " + std::to_string(most));
    return value;
}

inline CLI::Option* add_whole(CLI::App* command, const std::string& option, int& target, const std::string& help,
                              int least = INT_MIN, int most = INT_MAX) {
    return command
        ->add_option_function<std::string>(
            option, [=, &target](const std::string& text) { target = whole_in(text, option, least, most); }, help)
        ->type_name("INT");
}

/// An option for a decimal number.
inline CLI::Option* add_decimal(CLI::App* command, const std::string& option, double& target, const std::string& help) {
    return command
        ->add_option_function<std::string>(
            option,
            [&target, option](const std::string& text) {
                const auto [end, error] = std::from_chars(after_plus(text), text.data() + text.size(), target);
                if (end != text.data() + text.size() || error == std::errc::invalid_argument)
                    throw Error(ErrorKind::usage, option + ": '" + text + "' is no number");
                if (error == std::errc::result_out_of_range)
                    throw Error(ErrorKind::usage, option + ": '" + text + "' is far too large or too small");
            },
            help)
        ->type_name("FLOAT");
}

/// An option for a length in mm, taken exactly as written.
template <class Target>
CLI::Option* add_length(CLI::App* command, const std::string& option, Target& target, const std::string& help) {
    return command
        ->add_option_function<std::string>(
            option, [&target, option](const std::string& text) { target = parse_length(text, option); }, help)
        ->type_name("MM");
}

/// An option that is one of a few names.
template <class Target>
CLI::Option* add_choice(CLI::App* command, const std::string& option, Target& target,
                        const std::vector<std::pair<std::string, Target>>& choices, const std::string& help) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) names.push_back(name);
    return command
        ->add_option_function<std::string>(
            option,
            [&target, choices](const std::string& text) {
                target = std::find_if(choices.begin(), choices.end(), [&](const auto& choice) {
                             return choice.first == text;
                         })->second;
            },
            help)
        ->check(CLI::IsMember(names))
        ->type_name("NAME");
}

}  // namespace ribvault::cli
