// Adds options whose text is parsed by a function. Only files that define options may include this
// header.
#pragma once

#include "app/option_values.h"
#include "core/file_format.h"
#include "core/result.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cascade::option_groups {

/// Returns the value of an option. If the value is invalid, throws an error of CLI11, which
/// parse_options() catches.
template <typename T>
T value_or_throw(Result<T> value, const std::string& option) {
    if (value) return std::move(*value);
    const Failure& why = value.error();
    throw CLI::ValidationError(option, why.hint.empty()
                                           ? why.message
                                           : fmt::format("{} ({})", why.message, why.hint));
}

/// Adds an option. `parse` returns a Result<T> for the option's text, and `store` receives
/// the value.
template <typename Parse, typename Store>
CLI::Option* add_value(CLI::App& app, const std::string& names, const std::string& value,
                       const std::string& help, Parse parse, Store store) {
    const std::string name = names.substr(names.find("--"));
    return app
        .add_option_function<std::string>(
            names, [=](const std::string& text) { store(value_or_throw(parse(text), name)); }, help)
        ->type_name(value);
}

/// The following functions return functions that can be passed to add_value() as `parse`.
inline auto whole_number(std::int64_t low, std::int64_t high) {
    return [=](const std::string& text) { return parse_whole(text, low, high); };
}

inline auto odd_number(std::int64_t low, std::int64_t high) {
    return [=](const std::string& text) -> Result<std::int64_t> {
        auto number = parse_whole(text, low, high);
        if (number && *number % 2 == 0) {
            return failure(fmt::format("'{}' is not an odd number", text));
        }
        return number;
    };
}

inline auto path_of(FormatKind kind) {
    return [=](const std::string& text) { return parse_path_of(kind, text); };
}

inline auto one_of(std::vector<std::string> choices) {
    return [choices = std::move(choices)](const std::string& text) {
        return parse_choice(text, choices);
    };
}

}  // namespace cascade::option_groups
