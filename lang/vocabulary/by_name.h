// Numeric functions for other kinds of numbers, such as intervals: a kind has a function of the
// same name for each one that it supports.
#pragma once

#include "lang/vocabulary/functions.h"

namespace cascade {

/// Calls add(a, b), sqrt(a) or if_(a, b, c) of a kind of numbers, or returns `otherwise` if the
/// kind has none of this name.
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
