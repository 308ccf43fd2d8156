// The table of functions.
#include "lang/vocabulary/functions.h"

#include "core/enum_named.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr int cost_of_spatial = 20;

constexpr ResultKind result_of(FunctionKind kind) {
    const bool is_any = kind == FunctionKind::arithmetic || kind == FunctionKind::choice;
    return is_any ? ResultKind::like : ResultKind::number;
}

// clang-format off
constexpr FunctionInfo function_table[] = {
#define CASCADE_OPERATOR(id, spelling, arity, precedence, kind, linear, behaviour, cost, meaning) \
    {spelling, arity, precedence, FunctionKind::kind, result_of(FunctionKind::kind),              \
     Linear::linear, 0, Contexts::any, Domains::all, Behaviour::behaviour, cost, meaning},
#define CASCADE_NUMERIC(id, spelling, arity, ...) \
    CASCADE_OPERATOR(id, spelling, arity, FunctionInfo::of_a_name, __VA_ARGS__)
#define CASCADE_SPATIAL(id, spelling, arity, kind, result, linear, lengths, places, domains, meaning) \
    {spelling, arity, FunctionInfo::of_a_name, FunctionKind::kind, ResultKind::result,                \
     Linear::linear, lengths, Contexts::places, Domains::domains, Behaviour::plain,                   \
     cost_of_spatial, meaning},
#include "lang/vocabulary/functions.def"
};
// clang-format on

}  // namespace

const FunctionInfo& info(Function function) {
    return function_table[static_cast<std::size_t>(function)];
}

bool is_linear_in(Function function, std::size_t n, std::size_t count) {
    switch (info(function).linear) {
        case Linear::none: return false;
        case Linear::each:
        case Linear::together: return true;
        case Linear::first: return n == 0;
        case Linear::last: return n + 1 == count;
        case Linear::after_first: return n > 0;
        case Linear::but_last: return n + 1 < count;
    }
    return false;
}

ValueType type_of_result(Function function, std::span<const ValueType> operands) {
    switch (info(function).result) {
        case ResultKind::number: return ValueType::number;
        case ResultKind::vector: return ValueType::vector;
        case ResultKind::tensor: return ValueType::tensor;
        case ResultKind::colour: return ValueType::colour;
        case ResultKind::like: break;
    }
    // Vectors come first, because the product of a tensor and a vector is a vector.
    for (const ValueType type : {ValueType::vector, ValueType::tensor, ValueType::colour}) {
        if (std::ranges::find(operands, type) != operands.end()) return type;
    }
    return ValueType::number;
}

std::optional<Function> function_named(std::string_view name) {
    for (std::size_t i = 0; i < function_count; ++i) {
        const FunctionInfo& row = function_table[i];
        if (row.is_named && row.spelling == name) return static_cast<Function>(i);
    }
    return std::nullopt;
}

std::optional<Function> function_over(std::string_view name, std::string_view over) {
    for (std::size_t i = 0; i < function_count; ++i) {
        std::string_view rest = function_table[i].spelling;
        if (!rest.starts_with(name)) continue;
        rest.remove_prefix(name.size());
        if (rest.starts_with(" over ") && rest.substr(6) == over) return static_cast<Function>(i);
    }
    return std::nullopt;
}

std::optional<CellValue> cell_value_named(std::string_view name) {
    return enum_named<CellValue>(cell_value_names, name);
}

std::optional<int> component_named(std::string_view name) {
    const bool is_axis = name.size() == 1 && name[0] >= 'x' && name[0] <= 'z';
    return is_axis ? std::optional(name[0] - 'x') : std::nullopt;
}

std::optional<Builtin> builtin_named(std::string_view name) {
    return enum_named<Builtin>(builtin_names, name);
}

Derivative derivative_of(Function function) {
    const FunctionInfo& row = info(function);
    if (row.kind != FunctionKind::derivative) return {};
    const auto axis = [&](std::size_t letter) { return row.spelling[letter] - 'x'; };
    // One less, because the `d` is not an axis.
    const int order = static_cast<int>(row.spelling.size()) - 1;
    return {order, axis(1), axis(row.spelling.size() - 1)};
}

}  // namespace cascade
