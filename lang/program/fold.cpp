// The meaning of functions of numbers, in double precision, for what is known before a run.
#include "lang/program/fold.h"

#include <cmath>

namespace cascade {

namespace {

double truth(bool value) { return value ? 1.0 : 0.0; }

std::optional<double> fold_operator(Function function, double a, double b) {
    switch (function) {
        case Function::logical_or: return truth(a != 0 || b != 0);
        case Function::logical_and: return truth(a != 0 && b != 0);
        case Function::logical_not: return truth(a == 0);
        case Function::less: return truth(a < b);
        case Function::less_equal: return truth(a <= b);
        case Function::greater: return truth(a > b);
        case Function::greater_equal: return truth(a >= b);
        case Function::equal: return truth(a == b);
        case Function::not_equal: return truth(a != b);
        case Function::add: return a + b;
        case Function::subtract: return a - b;
        case Function::multiply: return a * b;
        case Function::divide: return a / b;
        case Function::negate: return -a;
        case Function::power: return std::pow(a, b);
        default: return std::nullopt;
    }
}

double fold_rounding(Function function, double a) {
    switch (function) {
        case Function::floor: return std::floor(a);
        case Function::ceil: return std::ceil(a);
        default: return std::nearbyint(a);  // Ties to even.
    }
}

/// Of the sign of b. `fmod` is exact and has the sign of a.
double fold_modulus(double a, double b) {
    const double rest = std::fmod(a, b);
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

double fold_min(double a, double b) { return std::isnan(a) || a < b ? a : b; }
double fold_max(double a, double b) { return std::isnan(a) || a > b ? a : b; }

double fold_smooth_step(double low, double high, double x) {
    const double t = fold_min(fold_max((x - low) / (high - low), 0), 1);
    return t * t * (3 - 2 * t);
}

std::optional<double> fold_elementary(Function function, double a, double b) {
    switch (function) {
        case Function::abs: return std::abs(a);
        case Function::sqrt: return std::sqrt(a);
        case Function::exp: return std::exp(a);
        case Function::log: return std::log(a);
        case Function::sin: return std::sin(a);
        case Function::cos: return std::cos(a);
        case Function::tan: return std::tan(a);
        case Function::asin: return std::asin(a);
        case Function::acos: return std::acos(a);
        case Function::atan: return std::atan(a);
        case Function::atan2: return std::atan2(a, b);
        case Function::sinh: return std::sinh(a);
        case Function::cosh: return std::cosh(a);
        case Function::tanh: return std::tanh(a);
        case Function::cbrt: return std::cbrt(a);
        case Function::hypot: return std::hypot(a, b);
        case Function::pow: return std::pow(a, b);
        default: return fold_operator(function, a, b);
    }
}

}  // namespace

std::optional<double> fold(Function function, std::span<const double> operands) {
    const double a = operands[0];
    const double b = operands[1];
    const double c = operands[2];
    switch (function) {
        case Function::if_: return a != 0 ? b : c;
        case Function::min: return fold_min(a, b);
        case Function::max: return fold_max(a, b);
        case Function::clamp: return fold_min(fold_max(a, b), c);
        case Function::mix: return a + (b - a) * c;
        case Function::step: return truth(a <= b);
        case Function::smoothstep: return fold_smooth_step(a, b, c);
        case Function::sign: return a > 0 ? 1 : a < 0 ? -1 : a;
        case Function::mod: return fold_modulus(a, b);
        case Function::floor:
        case Function::ceil:
        case Function::round: return fold_rounding(function, a);
        default: return fold_elementary(function, a, b);
    }
}

}  // namespace cascade
