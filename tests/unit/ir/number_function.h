// Runs functions of one or two numbers, as expanded by a builder, on many arguments at once.
#pragma once

#include "core/floating_point.h"
#include "core/plane.h"
#include "ir/builder.h"
#include "ir/contraction.h"
#include "ir/interpreter.h"
#include "ir/multiply_add.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cascade::test {

/// How a function is computed: as expanded, or contracted.
enum class Form { strict, contracted };

/// The forms that this processor can compute.
inline std::vector<Form> forms() {
    return has_multiply_add() ? std::vector{Form::strict, Form::contracted}
                              : std::vector{Form::strict};
}

inline const char* name_of(Form form) { return form == Form::strict ? "strict" : "contracted"; }

/// `expand(builder, x, y)` gives the value of the function, in the precision of the arguments.
template <typename Expand, typename Number>
std::vector<Number> apply_to_all(const Expand& expand, const std::vector<Number>& x,
                                 const std::vector<Number>& y, Backend& backend,
                                 Form form = Form::strict) {
    KernelBuilder builder(precision_of<Number>);
    const ValueId first = builder.field(builder.field_slot("x"));
    const ValueId second = builder.field(builder.field_slot("y"));
    builder.result("r", expand(builder, first, second));
    CellKernel kernel = std::move(builder).finish();
    if (form == Form::contracted) kernel = contracted(kernel);
    const Grid grid{static_cast<std::int64_t>(x.size()), 1, Boundary::periodic};
    const PlaneLayout layout(grid);
    Plane<Number> a(layout), b(layout), out(layout);
    std::copy(x.begin(), x.end(), a.origin());
    std::copy(y.begin(), y.end(), b.origin());
    const Number* fields[] = {a.origin(), b.origin()};
    Number* results[] = {out.origin()};
    const FlushDenormals environment;
    const KernelPointer compiled = *backend.compile(kernel, Stencil::row);
    compiled->run({fields, {}, {}, results, layout}, {0, 1});
    return {out.origin(), out.origin() + x.size()};
}

template <typename Expand, typename Number>
std::vector<Number> apply_to_all(const Expand& expand, const std::vector<Number>& x,
                                 const std::vector<Number>& y, Form form = Form::strict) {
    return apply_to_all(expand, x, y, *make_interpreter(), form);
}

/// A denormal argument counts as zero.
inline double flushed(float x) { return std::fabs(x) < 0x1p-126f ? std::copysign(0.0, x) : x; }
inline double flushed(double x) { return std::fabs(x) < 0x1p-1022 ? std::copysign(0.0, x) : x; }

/// The error of `value` in units in the last place of binary32 numbers of its size. Infinite if
/// only one of both is NaN or infinite, or if their signs differ. If the exact value is denormal, a
/// zero of its sign is right.
inline double error_in_ulp(float value, double exact) {
    constexpr double wrong = std::numeric_limits<double>::infinity();
    if (std::isnan(exact) || std::isnan(value))
        return std::isnan(exact) && std::isnan(value) ? 0 : wrong;
    if (std::signbit(exact) != std::signbit(value)) return wrong;
    if (std::fabs(exact) < 0x1p-126) return std::fabs(value) <= 0x1p-126f ? 0 : wrong;
    if (std::isinf(static_cast<float>(exact)))
        return std::fabs(value) >= 0x1.fffffep127f ? 0 : wrong;
    if (std::isinf(value)) return std::fabs(exact) > 0x1.fffffep127 ? 0 : wrong;
    return std::fabs(value - exact) / std::ldexp(1.0, std::max(std::ilogb(exact), -126) - 23);
}

/// The error of a binary64 value in units of the last place.
inline double error_in_ulp(double value, long double exact) {
    constexpr double wrong = std::numeric_limits<double>::infinity();
    constexpr long double largest = std::numeric_limits<double>::max();
    if (std::isnan(exact) || std::isnan(value))
        return std::isnan(exact) && std::isnan(value) ? 0 : wrong;
    if (std::signbit(exact) != std::signbit(value)) return wrong;
    if (std::fabs(exact) < 0x1p-1022L) return std::fabs(value) <= 0x1p-1022 ? 0 : wrong;
    if (std::isinf(static_cast<double>(exact))) return std::fabs(value) >= largest ? 0 : wrong;
    if (std::isinf(value)) return std::fabs(exact) > largest ? 0 : wrong;
    const int place = std::max(std::ilogb(exact), -1022) - 52;
    return static_cast<double>(std::fabs(value - exact) / std::ldexp(1.0L, place));
}

}  // namespace cascade::test
