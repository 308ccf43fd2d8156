// Small kernels in which conditions select constants. LLVM would fold computations with these
// constants without flushing denormals.
#include "ir/interpreter.h"
#include "ir/multiply_add.h"
#include "jit/jit.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/random_stream.h"

#include <gtest/gtest.h>

#include <vector>

namespace cascade::test {
namespace {

constexpr std::uint32_t telling_words[] = {
    0x00000000, 0x80000000, 0x3f800000, 0xbf800000, 0x40000000,  // 0, −0, 1, −1, 2
    0x00000001, 0x80000001, 0x00400000, 0x00800000,              // denormals, the smallest normal
    0x7f800000, 0xff800000, 0x7fc00000, 0x7f7fffff, 0x41200000,  // infinities, NaN, largest, 10
};

/// A kernel of arithmetic, comparisons and selections on two masks, constants and, in half of the
/// kernels, a field.
class ChoiceKernel {
public:
    explicit ChoiceKernel(std::uint64_t seed) : stream_(seed) {
        kernel_.field_names = {"x"};
        kernel_.mask_names = {"m", "n"};
        kernel_.result_names = {"r"};
        values_ = {emit(Op::mask, {}, 0), emit(Op::mask, {}, 1)};
        if (stream_.chance(50)) values_.push_back(emit(Op::field, {}, 0));
        const std::uint32_t count = 2 + stream_.below(5);
        for (std::uint32_t k = 0; k < count; ++k) values_.push_back(step());
        kernel_.results = {values_.back()};
    }

    const CellKernel& kernel() const { return kernel_; }

private:
    ValueId step() {
        switch (stream_.below(6)) {
            case 0: return ternary(Op::select);
            case 1: return ternary(has_multiply_add() ? Op::multiply_add : Op::select);
            case 5: return unary();
            case 2: return binary(Op::less, Op::logical_or);
            default: return binary(Op::add, Op::divide);
        }
    }

    ValueId unary() { return emit(one_of(Op::negate, Op::round_to_even), {operand()}, 0); }

    ValueId ternary(Op op) {
        const ValueId a = operand(), b = operand(), c = operand();
        return emit(op, {a, b, c}, 0);
    }

    ValueId binary(Op first, Op last) {
        const ValueId a = operand(), b = operand();
        return emit(one_of(first, last), {a, b}, 0);
    }

    Op one_of(Op first, Op last) {
        const auto count = static_cast<std::uint32_t>(last) - static_cast<std::uint32_t>(first) + 1;
        return static_cast<Op>(static_cast<std::uint32_t>(first) + stream_.below(count));
    }

    ValueId operand() {
        if (stream_.chance(35))
            return emit(Op::constant, {}, stream_.pick<std::uint32_t>(telling_words));
        return values_[stream_.below(values_.size())];
    }

    ValueId emit(Op op, std::array<ValueId, 3> operands, std::uint32_t payload) {
        const ValueId made = kernel_.code.next();
        kernel_.code.push_back({op, operands, payload});
        return made;
    }

    RandomStream stream_;
    CellKernel kernel_;
    std::vector<ValueId> values_;
};

TEST(JitChoices, AgreeWithTheInterpreter) {
    std::vector<std::unique_ptr<Backend>> backends;
    for (const int lanes : {4, 8, 16}) {
        for (const int optimise : {0, 2}) {
            auto made = make_jit({lanes, optimise});
            ASSERT_TRUE(made);
            backends.push_back(std::move(*made));
        }
    }
    const auto interpreter = make_interpreter();
    const Grid grid{40, 2, Boundary::periodic};
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        const CellKernel kernel = ChoiceKernel(seed).kernel();
        ASSERT_EQ(verify(kernel), "");
        Backend& jit = *backends[seed % backends.size()];
        const auto expected = run_kernel(*interpreter, kernel, grid, seed);
        ASSERT_EQ(same_bits(expected, run_kernel(jit, kernel, grid, seed)), "")
            << "seed " << seed << "\n"
            << print(kernel);
    }
}

}  // namespace
}  // namespace cascade::test
