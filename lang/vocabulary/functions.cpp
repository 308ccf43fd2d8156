// The table of functions.
#include "lang/vocabulary/functions.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr bool is_operator(std::string_view spelling) {
    const char first = spelling.front();
    const bool is_word = first >= 'a' && first <= 'z';
    return !is_word || spelling == "or" || spelling == "and" || spelling == "not";
}

constexpr bool is_aggregate(std::string_view spelling) {
    return spelling.ends_with(" over domain");
}

constexpr auto any = Places::any;
constexpr auto cells = Places::cells;
constexpr auto rates = Places::rates;
constexpr auto values = Places::values;
constexpr auto noisy = Places::noisy;
constexpr auto picture = Places::picture;

constexpr FunctionInfo function_table[] = {
#define CASCADE_FUNCTION(id, spelling, arity, places, meaning) \
    {spelling, arity, places, meaning, is_operator(spelling), \
     is_aggregate(spelling)},
#include "lang/vocabulary/functions.def"
#undef CASCADE_FUNCTION
};

}  // namespace

const FunctionInfo& info(Function function) {
    return function_table[static_cast<std::size_t>(function)];
}

std::optional<Function> function_named(std::string_view name) {
    for (std::size_t i = 0; i < function_count; ++i) {
        const FunctionInfo& row = function_table[i];
        if (!row.is_operator && row.spelling == name) return static_cast<Function>(i);
    }
    return std::nullopt;
}

std::optional<Builtin> builtin_named(std::string_view name) {
    const auto found = std::find(builtin_names.begin(), builtin_names.end(), name);
    if (found == builtin_names.end()) return std::nullopt;
    return static_cast<Builtin>(found - builtin_names.begin());
}

bool is_random(Function function) {
    switch (function) {
        case Function::random:
        case Function::normal:
        case Function::white:
        case Function::noise:
        case Function::lattice:
        case Function::diamond: return true;
        default: return false;
    }
}

bool varies_by_cell(Function function) {
    const Places places = info(function).places;
    return places != Places::any && places != Places::picture;
}

bool reads_file(Function function) {
    switch (function) {
        case Function::field:
        case Function::image:
        case Function::attr:
        case Function::uvimage: return true;
        default: return false;
    }
}

bool needs_model(Function function) {
    switch (function) {
        case Function::attr:
        case Function::uvimage:
        case Function::distance:
        case Function::keys: return true;
        default: return false;
    }
}

bool differentiates(Function function) {
    return Function::lap <= function && function <= Function::div;
}

}  // namespace cascade
