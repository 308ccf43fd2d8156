// The size of a JSON text of unknown origin, measured without allocating.
#pragma once

#include <cstddef>
#include <string_view>

namespace cascade {

struct JsonSize {
    std::size_t objects = 0;  ///< Objects and arrays.
    std::size_t values = 0;   ///< All values; each array may add an error of one.
    std::size_t depth = 0;    ///< Depth of nesting.
};

/// Counts braces, brackets and commas outside of strings. Also works on texts that are no JSON.
JsonSize measure_json(std::string_view text);

/// Whether a text of settings is small enough to be parsed: a parser needs many times the memory of
/// a text of nothing but brackets, and some recurse at each level.
bool is_small_json(std::string_view text);

}  // namespace cascade
