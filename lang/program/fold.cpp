// Evaluates functions of numbers in double precision, if their values are known before a run.
#include "lang/program/fold.h"

#include <cmath>

namespace cascade {

namespace {

double truth(bool value) { return value ? 1.0 : 0.0; }

/// The remainder with the sign of b. `fmod` is exact but has the sign of a.
double modulus(double a, double b) {
    const double rest = std::fmod(a, b);
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

double lesser(double a, double b) { return std::isnan(a) || a < b ? a : b; }
double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

double smooth_step(double low, double high, double x) {
    const double t = lesser(larger((x - low) / (high - low), 0), 1);
    return t * t * (3 - 2 * t);
}

}  // namespace

bool fold(Function function, const OperandColumns& operands, std::span<double> values) {
    const auto fill = [&](auto value_of) {
        for (std::size_t k = 0; k < values.size(); ++k) {
            values[k] = value_of(operands[0][k], operands[1][k], operands[2][k]);
        }
        return true;
    };
    switch (function) {
        // clang-format off
#define CASCADE_ELEMENTARY(id, value, ...) \
        case Function::id: \
            return fill([]([[maybe_unused]] double a, [[maybe_unused]] double b, \
                           [[maybe_unused]] double c) -> double { return value; });
#include "lang/vocabulary/elementary.def"
        // clang-format on
        default: return false;
    }
}

std::optional<double> fold(Function function, std::span<const double> operands) {
    // The domain may grow during a stage, so the value is not known.
    if (function == Function::grown) return std::nullopt;
    [[maybe_unused]] const double a = operands[0], b = operands[1], c = operands[2];
    switch (function) {
        // clang-format off
#define CASCADE_ELEMENTARY(id, value, ...) case Function::id: return value;
#include "lang/vocabulary/elementary.def"
        // clang-format on
        default: return std::nullopt;
    }
}

}  // namespace cascade
