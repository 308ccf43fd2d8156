// Scaling by powers of two and rounding to whole numbers, for all exponents: the interpreter,
// instructions of the processor and the sequences that replace these give the bits of the C
// library.
#include "jit/jit.h"
#include "tests/unit/ir/number_function.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace cascade::test {
namespace {

constexpr double largest_exponent(float) { return 252; }
constexpr double largest_exponent(double) { return 2044; }

/// Numbers of both signs with every `stride`th exponent, from denormal numbers to infinities and
/// NaN: powers of two, their neighbours, and others.
template <typename Number>
std::vector<Number> numbers(std::uint64_t stride) {
    constexpr WordFormat format = format_of(precision_of<Number>);
    const std::uint64_t last = format.exponent() >> format.fraction_bits;
    std::vector<Number> all;
    const auto add = [&](std::uint64_t exponent) {
        for (const std::uint64_t fraction :
             {std::uint64_t{0}, std::uint64_t{1}, format.fraction() / 3, format.fraction()}) {
            const auto word =
                static_cast<WordOf<Number>>(exponent << format.fraction_bits | fraction);
            all.push_back(std::bit_cast<Number>(word));
            all.push_back(-all.back());
        }
    };
    for (std::uint64_t exponent = 0; exponent < last; exponent += stride) add(exponent);
    add(last);
    return all;
}

/// Flushes denormal numbers to zero. Results are flushed before they are rounded.
template <typename Number>
Number flushed(long double x) {
    const auto number = static_cast<Number>(x);
    return std::fabs(x) < std::numeric_limits<Number>::min() ? std::copysign(Number{0}, number)
                                                             : number;
}

template <typename Number>
Number scaled(Number x, double power) {
    const long double number = flushed<Number>(x);
    return flushed<Number>(std::ldexp(number, static_cast<int>(power)));
}

/// Returns the interpreter, followed by backends for vectors of all widths.
std::vector<std::unique_ptr<Backend>> backends() {
    std::vector<std::unique_ptr<Backend>> all;
    all.push_back(make_interpreter());
    for (const int lanes : {4, 8, 16}) all.push_back(std::move(*make_jit({lanes, 2})));
    return all;
}

template <typename Number>
void expect_bits(const std::vector<Number>& values, const std::vector<Number>& exact,
                 const std::vector<Number>& x, const std::vector<Number>& n) {
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (std::isnan(exact[k]) && std::isnan(values[k])) continue;
        using Word = WordOf<Number>;
        ASSERT_EQ(std::bit_cast<Word>(values[k]), std::bit_cast<Word>(exact[k]))
            << values[k] << ", not " << exact[k] << ", of " << x[k] << " and " << n[k];
    }
}

template <typename Number>
void check_scaling(std::uint64_t stride, double power_stride) {
    std::vector<Number> x, n, exact;
    const double largest = largest_exponent(Number{});
    for (const Number number : numbers<Number>(stride)) {
        for (double power = -largest; power <= largest; power += power_stride) {
            x.push_back(number);
            n.push_back(static_cast<Number>(power));
            exact.push_back(scaled(number, power));
        }
    }
    const auto expand = [](KernelBuilder& builder, ValueId a, ValueId b) {
        return builder.apply(Op::scale_by_power, a, b);
    };
    for (const auto& backend : backends()) {
        expect_bits(apply_to_all(expand, x, n, *backend), exact, x, n);
    }
}

TEST(WholeNumbers, ScalingIsExactFlushedOrInfinite) { check_scaling<float>(1, 1); }
TEST(WholeNumbers, ScalingIsSoInBinary64) { check_scaling<double>(11, 7); }

template <typename Number>
void check_rounding() {
    std::vector<Number> x = numbers<Number>(1), exact;
    for (int k = -40; k <= 40; ++k) x.push_back(static_cast<Number>(k) / 4);
    for (const Number number : x) exact.push_back(std::nearbyint(flushed<Number>(number)));
    const auto expand = [](KernelBuilder& builder, ValueId a, ValueId) {
        return builder.apply(Op::round_to_even, a);
    };
    for (const auto& backend : backends()) {
        expect_bits(apply_to_all(expand, x, x, *backend), exact, x, x);
    }
}

TEST(WholeNumbers, RoundingIsToEven) { check_rounding<float>(); }
TEST(WholeNumbers, RoundingIsSoInBinary64) { check_rounding<double>(); }

/// Checks the scaling of constants, and scaling by constants. LLVM may fold both.
template <typename Number>
void check_constants() {
    const std::vector<Number> x = numbers<Number>(1);
    for (const double power : {0.0, 1.0, -1.0, -30.0}) {
        std::vector<Number> exact;
        for (const Number number : x) exact.push_back(scaled(number, power));
        const auto expand = [&](KernelBuilder& builder, ValueId a, ValueId) {
            return builder.apply(Op::scale_by_power, a, builder.number(power));
        };
        for (const auto& backend : backends()) {
            expect_bits(apply_to_all(expand, x, x, *backend), exact, x, x);
        }
    }
}

TEST(WholeNumbers, ScalingByConstants) {
    check_constants<float>();
    check_constants<double>();
}

}  // namespace
}  // namespace cascade::test
