// The tables of functions are consistent with each other.
#include "lang/calculus/derivative_rules.h"
#include "lang/program/fold.h"
#include "lang/vocabulary/functions.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace cascade::test {
namespace {

std::string spelling(Function function) { return std::string(info(function).spelling); }

template <typename Visit>
void for_each_function(const Visit& visit) {
    for (std::size_t k = 0; k < function_count; ++k) visit(static_cast<Function>(k));
}

TEST(Functions, OfNumbersHaveAValueAndOthersHaveNone) {
    const std::array<double, most_operands> ones{1, 1, 1, 1, 1, 1};
    for_each_function([&](Function function) {
        const bool is_known = is_elementary(function) && function != Function::grown;
        EXPECT_EQ(fold(function, ones).has_value(), is_known) << spelling(function);
    });
}

TEST(Functions, ThatJumpHaveNoSlope) {
    Algebra algebra;
    Node call{Call()};
    for (std::size_t k = 0; k < 3; ++k) call.operands[k] = algebra.leaf(ItemId(k));
    for_each_function([&](Function function) {
        call.function = function;
        call.operand_count = static_cast<std::uint8_t>(info(function).arity.least);
        for (std::size_t n = 0; is_elementary(function) && n < call.operand_count; ++n) {
            const auto slope = partial_derivative(algebra, call, n);
            const bool is_edge = function == Function::smoothstep && n < 2;
            EXPECT_EQ(slope.has_value(), !is_edge) << spelling(function) << n;
            if (!slope) continue;
            const bool is_axis = function == Function::grown && n == 1;
            EXPECT_EQ(algebra.is_number(*slope, 0), jumps_by(function, n) || is_axis)
                << spelling(function) << n;
        }
    });
}

TEST(Functions, HaveSlopesWithoutTheOperandsInWhichTheyAreLinear) {
    Algebra algebra;
    Node call{Call()};
    for (std::size_t k = 0; k < 3; ++k) call.operands[k] = algebra.leaf(ItemId(k));
    for_each_function([&](Function function) {
        call.function = function;
        const auto count = static_cast<std::size_t>(info(function).arity.least);
        call.operand_count = static_cast<std::uint8_t>(count);
        for (std::size_t n = 0; is_elementary(function) && n < count; ++n) {
            if (!is_linear_in(function, n, count)) continue;
            const auto slope = partial_derivative(algebra, call, n);
            ASSERT_TRUE(slope) << spelling(function);
            const auto depends = needed_by(algebra, {&*slope, 1});
            EXPECT_FALSE(depends[call.operands[n]]) << spelling(function) << n;
        }
    });
}

TEST(Functions, OfVectorsMakeTheTypeOfTheirRow) {
    using enum ValueType;
    const auto type = [](Function function, std::initializer_list<ValueType> operands) {
        return type_of_result(function, {operands.begin(), operands.size()});
    };
    EXPECT_EQ(type(Function::multiply, {tensor, vector}), vector);
    EXPECT_EQ(type(Function::multiply, {number, tensor}), tensor);
    EXPECT_EQ(type(Function::if_, {number, colour, colour}), colour);
    EXPECT_EQ(type(Function::grad, {number}), vector);
    EXPECT_EQ(type(Function::div, {vector}), number);
    EXPECT_EQ(type(Function::touching_mean, {vector}), vector);
}

TEST(Functions, DerivativesAreSpelledByTheirAxes) {
    const auto axes = [](Function function) {
        const Derivative derivative = derivative_of(function);
        return std::array{derivative.order, derivative.first, derivative.second};
    };
    EXPECT_EQ(axes(Function::dx), (std::array{1, 0, 0}));
    EXPECT_EQ(axes(Function::dz), (std::array{1, 2, 2}));
    EXPECT_EQ(axes(Function::dyy), (std::array{2, 1, 1}));
    EXPECT_EQ(axes(Function::dxz), (std::array{2, 0, 2}));
    EXPECT_EQ(axes(Function::div), (std::array{0, 0, 0}));
    EXPECT_TRUE(derivative_of(Function::dyz).is_mixed());
    EXPECT_FALSE(derivative_of(Function::dzz).is_mixed());
}

TEST(Functions, HaveAMeaningOnTheDomainsOfTheirRow) {
    const auto domains = [](Function function) { return info(function).domains; };
    EXPECT_TRUE(includes(domains(Function::dz), Domains::model));
    EXPECT_FALSE(includes(domains(Function::dz), Domains::surface));
    EXPECT_FALSE(includes(domains(Function::dxy), Domains::model));
    EXPECT_TRUE(includes(domains(Function::advect), Domains::surface));
    EXPECT_FALSE(includes(domains(Function::advect), Domains::model));
    EXPECT_TRUE(needs_model(Function::keys));
}

}  // namespace
}  // namespace cascade::test
