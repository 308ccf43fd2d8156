// The interpreter's inner loops. Each operation has a separate loop for every choice of the
// operands that are scalars, except the choice of all operands. This file also computes the
// operations on single words.
//
// The compiler can vectorise a loop only if it knows which operands are scalars, so a loop whose
// strides of 0 or 1 are chosen at run time would be slower.
#include "ir/block_loops.h"

#include "core/check.h"
#include "ir/interpreter.h"
#include "ir/multiply_add.h"
#include "ir/word_operations.h"

#include <array>
#include <utility>

namespace cascade {
namespace {

constexpr unsigned scalar_choices = 8;

template <Op op, unsigned scalars, typename Number>
void loop(Number* __restrict out, const Number* a, const Number* b, const Number* c,
          std::int64_t count) {
    using Word = WordOf<Number>;
    constexpr int arity = info_arity(op);
    for (std::int64_t i = 0; i < count; ++i) {
        Word x = 0, y = 0, z = 0;
        x = std::bit_cast<Word>(a[scalars & 1 ? 0 : i]);
        if constexpr (arity > 1) y = std::bit_cast<Word>(b[scalars & 2 ? 0 : i]);
        if constexpr (arity > 2) z = std::bit_cast<Word>(c[scalars & 4 ? 0 : i]);
        out[i] = std::bit_cast<Number>(word_operation<op, Number>(x, y, z));
    }
}

template <Op op, unsigned scalars, typename Number>
constexpr BlockLoop<Number> loop_or_null() {
    constexpr unsigned all = (1u << info_arity(op)) - 1;
    if constexpr (is_function_of_operands(op) && scalars < all) {
        return &loop<op, scalars, Number>;
    } else {
        return nullptr;
    }
}

template <typename Number>
using Choices = std::array<BlockLoop<Number>, scalar_choices>;

template <Op op, typename Number, unsigned... scalars>
constexpr Choices<Number> loops_of(std::integer_sequence<unsigned, scalars...>) {
    return {loop_or_null<op, scalars, Number>()...};
}

template <typename Number>
constexpr std::array<Choices<Number>, op_count> loops = {
#define CASCADE_OPERATION(name, arity, payload, meaning) \
    loops_of<Op::name, Number>(std::make_integer_sequence<unsigned, scalar_choices>{}),
#include "ir/operations.def"
#undef CASCADE_OPERATION
};

template <Op op, typename Number, typename Word = WordOf<Number>>
Word evaluate_one(Word a, Word b, Word c) {
    if constexpr (is_function_of_operands(op)) {
        return word_operation<op, Number>(a, b, c);
    } else {
        CHECK(false, "interpreter: the value of a source needs a cell");
    }
}

template <typename Number, typename Word = WordOf<Number>>
Word evaluate_words(Op op, Word a, Word b, Word c) {
    switch (op) {
#define CASCADE_OPERATION(name, arity, payload, meaning) \
    case Op::name:                                       \
        return evaluate_one<Op::name, Number>(a, b, c);
#include "ir/operations.def"
#undef CASCADE_OPERATION
    }
    CHECK(false, "interpreter: the operation is one of the table");
}

}  // namespace

template <typename Number>
BlockLoop<Number> block_loop(Op op, unsigned scalar_operands) {
    CHECK(scalar_operands < scalar_choices, "interpreter: operations have up to three operands");
    if (op == Op::multiply_add && has_multiply_add()) {
        return multiply_add_loop<Number>(scalar_operands);
    }
    const BlockLoop<Number> result = loops<Number>[static_cast<std::size_t>(op)][scalar_operands];
    CHECK(result, "interpreter: the operation has an operand that varies over the cells");
    return result;
}

template BlockLoop<float> block_loop<float>(Op, unsigned);
template BlockLoop<double> block_loop<double>(Op, unsigned);

std::uint32_t evaluate(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return evaluate_words<float>(op, a, b, c);
}

std::uint64_t evaluate(Op op, std::uint64_t a, std::uint64_t b, std::uint64_t c,
                       Precision precision) {
    if (precision == Precision::binary64) return evaluate_words<double>(op, a, b, c);
    const auto word = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits); };
    return evaluate(op, word(a), word(b), word(c));
}

}  // namespace cascade
