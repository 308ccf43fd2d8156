// The interpreter's inner loops, one for each operation and each choice of scalar operands; and the
// same meaning for single words.
//
// A loop per choice, rather than a stride of 0 or 1 at run time, lets the compiler vectorise each.
#include "ir/block_loops.h"

#include "core/check.h"
#include "ir/interpreter.h"
#include "ir/word_operations.h"

#include <array>
#include <utility>

namespace cascade {
namespace {

constexpr unsigned scalar_choices = 8;

template <Op op, unsigned scalars>
void loop(float* __restrict out, const float* a, const float* b, const float* c,
          std::int64_t count) {
    constexpr int arity = info_arity(op);
    for (std::int64_t i = 0; i < count; ++i) {
        std::uint32_t x = 0, y = 0, z = 0;
        x = std::bit_cast<std::uint32_t>(a[scalars & 1 ? 0 : i]);
        if constexpr (arity > 1) y = std::bit_cast<std::uint32_t>(b[scalars & 2 ? 0 : i]);
        if constexpr (arity > 2) z = std::bit_cast<std::uint32_t>(c[scalars & 4 ? 0 : i]);
        out[i] = std::bit_cast<float>(word_operation<op>(x, y, z));
    }
}

template <Op op, unsigned scalars>
constexpr BlockLoop loop_or_null() {
    constexpr unsigned all = (1u << info_arity(op)) - 1;
    if constexpr (is_function_of_operands(op) && scalars < all) {
        return &loop<op, scalars>;
    } else {
        return nullptr;
    }
}

template <Op op, unsigned... scalars>
constexpr std::array<BlockLoop, scalar_choices> loops_of(
    std::integer_sequence<unsigned, scalars...>) {
    return {loop_or_null<op, scalars>()...};
}

constexpr std::array<std::array<BlockLoop, scalar_choices>, op_count> loops = {
#define CASCADE_OPERATION(name, arity, payload, meaning) \
    loops_of<Op::name>(std::make_integer_sequence<unsigned, scalar_choices>{}),
#include "ir/operations.def"
#undef CASCADE_OPERATION
};

template <Op op>
std::uint32_t evaluate_one(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if constexpr (is_function_of_operands(op)) {
        return word_operation<op>(a, b, c);
    } else {
        CHECK(false, "interpreter: the value of a source needs a cell");
    }
}

}  // namespace

BlockLoop block_loop(Op op, unsigned scalar_operands) {
    CHECK(scalar_operands < scalar_choices, "interpreter: operations have up to three operands");
    const BlockLoop result = loops[static_cast<std::size_t>(op)][scalar_operands];
    CHECK(result, "interpreter: the operation has an operand that varies over the cells");
    return result;
}

std::uint32_t evaluate(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    switch (op) {
#define CASCADE_OPERATION(name, arity, payload, meaning) \
    case Op::name: return evaluate_one<Op::name>(a, b, c);
#include "ir/operations.def"
#undef CASCADE_OPERATION
    }
    CHECK(false, "interpreter: the operation is one of the table");
}

}  // namespace cascade
