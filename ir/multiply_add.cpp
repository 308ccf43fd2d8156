// The loops for a · b + c: a separate loop for every choice of the operands that are scalars,
// except the choice of all three. A function attribute compiles the loops for AVX2 and FMA.
#include "ir/multiply_add.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#if defined(__x86_64__)
#define CASCADE_WITH_MULTIPLY_ADD [[gnu::target("avx2,fma")]]
#else
#define CASCADE_WITH_MULTIPLY_ADD
#endif

namespace cascade {
namespace {

/// The number of choices of the scalar operands, not counting the choice of all three.
constexpr unsigned varying_choices = 7;

template <unsigned scalars, typename Number>
CASCADE_WITH_MULTIPLY_ADD void multiply_add_block(Number* __restrict out, const Number* a,
                                                  const Number* b, const Number* c,
                                                  std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
        const Number x = a[scalars & 1 ? 0 : i];
        const Number y = b[scalars & 2 ? 0 : i];
        const Number z = c[scalars & 4 ? 0 : i];
        if constexpr (std::is_same_v<Number, float>) {
            out[i] = __builtin_fmaf(x, y, z);
        } else {
            out[i] = __builtin_fma(x, y, z);
        }
    }
}

template <typename Number, unsigned... scalars>
constexpr std::array<BlockLoop<Number>, varying_choices> multiply_add_blocks(
    std::integer_sequence<unsigned, scalars...>) {
    return {&multiply_add_block<scalars, Number>...};
}

}  // namespace

bool has_multiply_add() {
#if defined(__x86_64__)
    static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return has;
#elif defined(__aarch64__)
    return true;
#else
    return false;
#endif
}

bool multiplies_and_adds(const CellKernel& kernel) {
    return std::any_of(kernel.code.begin(), kernel.code.end(), [](const Instruction& instruction) {
        return instruction.op == Op::multiply_add;
    });
}

template <typename Number>
BlockLoop<Number> multiply_add_loop(unsigned scalar_operands) {
    static constexpr auto loops =
        multiply_add_blocks<Number>(std::make_integer_sequence<unsigned, varying_choices>{});
    return loops.at(scalar_operands);
}

template BlockLoop<float> multiply_add_loop<float>(unsigned);
template BlockLoop<double> multiply_add_loop<double>(unsigned);

}  // namespace cascade
