// How much a JSON text of unknown origin holds, found without building anything of it.
#pragma once

#include <cstddef>
#include <string_view>

namespace cascade {

struct JsonSize {
    std::size_t objects = 0;  ///< And lists.
    std::size_t values = 0;   ///< All of them, within one of each list.
    std::size_t depth = 0;    ///< Objects and lists within each other.
};

/// Counts braces, brackets and commas outside of texts. What is no JSON has some size, too.
JsonSize measure_json(std::string_view text);

/// May a text of settings be parsed? A parser takes many times the memory of a text of nothing but
/// brackets, and some call themselves for each level.
bool is_small_json(std::string_view text);

}  // namespace cascade
