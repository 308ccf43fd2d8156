// The size of a JSON text of unknown origin, measured without allocating.
#pragma once

#include <cstddef>
#include <string_view>

namespace cascade {

struct JsonSize {
    std::size_t objects = 0;  ///< Number of objects and arrays.
    std::size_t values =
        0;  ///< Number of values, which may be too low by 1 for each object or array.
    std::size_t depth = 0;  ///< Depth of nesting.
};

/// Counts braces, brackets and commas outside of strings. Also works on texts that are not JSON.
JsonSize measure_json(std::string_view text);

/// Whether JSON settings are small enough to parse. For a text of brackets, a parser needs memory
/// of many times the text's size, and some parsers recurse for each nested bracket.
bool is_small_json(std::string_view text);

}  // namespace cascade
