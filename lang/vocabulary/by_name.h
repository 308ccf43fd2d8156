// Calls numeric functions of the language on other kinds of numbers, such as intervals. For each
// function that a kind supports, the kind defines a C++ function of the same name.
#pragma once

#include "lang/vocabulary/functions.h"

namespace cascade {

/// Calls the C++ function `name` of a kind of numbers, such as add(a, b), sqrt(a) or if_(a, b, c).
/// Returns `otherwise` if the kind does not define the function.
template <typename Value>
Value call_by_name(Function function, const Value& a, const Value& b, const Value& c,
                   const Value& otherwise = {}) {
    switch (function) {
#define CASCADE_OPERATOR(name, spelling, arity, ...)                                   \
    case Function::name:                                                               \
        if constexpr (arity == 1 && requires { name(a); }) return name(a);             \
        if constexpr (arity == 2 && requires { name(a, b); }) return name(a, b);       \
        if constexpr (arity == 3 && requires { name(a, b, c); }) return name(a, b, c); \
        break;
#define CASCADE_NUMERIC(name, spelling, arity, ...) CASCADE_OPERATOR(name, spelling, arity)
#define CASCADE_SPATIAL(...)
#include "lang/vocabulary/functions.def"
        default: break;
    }
    return otherwise;
}

}  // namespace cascade
