// Chooses the operands and the operations.
#include "device/probed_kernel.h"

#include "ir/builder.h"
#include "ir/multiply_add.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <string>
#include <utility>

namespace cascade {
namespace {

template <typename Number>
std::vector<WordOf<Number>> hard_words() {
    constexpr WordFormat format = format_of(precision_of<Number>);
    std::vector<WordOf<Number>> words;
    const auto add = [&](std::uint64_t word) {
        words.push_back(static_cast<WordOf<Number>>(word));
        words.push_back(static_cast<WordOf<Number>>(word ^ format.sign()));
    };
    const std::uint64_t one = format.one(), least = format.fraction() + 1;
    for (const std::uint64_t word :
         {std::uint64_t{0}, std::uint64_t{1}, format.fraction(), least, least + 1, 2 * least - 1,
          format.exponent() - 1, format.exponent(), format.nan(), one, one - 1, one + 1, one + 2}) {
        add(word);
    }
    // Numbers with irregular digits, and with exponents from the least to the largest, for
    // quotients and roots.
    std::uint64_t digits = 0x9e3779b97f4a7c15;
    for (const int exponent : {1, 2, format.bias / 2, format.bias - 1, format.bias,
                               format.bias + format.fraction_bits, 2 * format.bias}) {
        digits = digits * 6364136223846793005 + 1442695040888963407;
        const std::uint64_t fraction = digits >> (64 - format.fraction_bits);
        add(static_cast<std::uint64_t>(exponent) << format.fraction_bits | fraction);
    }
    // Ties of round_to_even, and integers of at least 2^23.
    for (const double number : {0.5, 1.5, 2.5, 8388607.5, 3.0, 10.0}) {
        words.push_back(static_cast<WordOf<Number>>(word_of(number, precision_of<Number>)));
    }
    return words;
}

constexpr std::array probed_operations{Op::add,          Op::subtract,      Op::multiply,
                                       Op::divide,       Op::square_root,   Op::round_to_even,
                                       Op::multiply_add, Op::less,          Op::less_equal,
                                       Op::equal,        Op::not_equal,     Op::logical_not,
                                       Op::select,       Op::bits_to_number};

/// A kernel with a result for each probed operation on fields a and b. multiply_add adds b.
CellKernel probing_kernel(Precision precision) {
    KernelBuilder builder(precision);
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId b = builder.field(builder.field_slot("b"));
    for (const Op op : probed_operations) {
        if (op == Op::multiply_add && !has_multiply_add()) continue;
        const std::string name(info(op).name);
        switch (info(op).arity) {
            case 1: builder.result(name, builder.apply(op, a)); break;
            case 2: builder.result(name, builder.apply(op, a, b)); break;
            default: builder.result(name, builder.apply(op, a, b, b));
        }
    }
    // A compiler that ignores flushing replaces these results by a.
    builder.result("a * 1", builder.multiply(a, builder.number(1)));
    builder.result("a + -0", builder.add(a, builder.word(builder.format().sign())));
    builder.result("least", builder.select(builder.apply(Op::less, a, b), a, b));
    return std::move(builder).finish();
}

}  // namespace

template <typename Number>
ProbedKernel<Number>::ProbedKernel()
    : kernel(probing_kernel(precision_of<Number>)),
      words(hard_words<Number>()),
      grid{static_cast<std::int64_t>(words.size()), static_cast<std::int64_t>(words.size())} {}

template <typename Number>
std::vector<Plane<Number>> ProbedKernel<Number>::arguments() const {
    const PlaneLayout layout(grid);
    std::vector<Plane<Number>> planes;
    for (int k = 0; k < 2; ++k) planes.emplace_back(layout);
    for (std::int64_t j = 0; j < layout.height; ++j) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            planes[0].row(j)[i] = std::bit_cast<Number>(words[static_cast<std::size_t>(i)]);
            planes[1].row(j)[i] = std::bit_cast<Number>(words[static_cast<std::size_t>(j)]);
        }
    }
    return planes;
}

template <typename Number>
std::vector<Plane<Number>> ProbedKernel<Number>::results_of(const Kernel& compiled) const {
    const PlaneLayout layout(grid);
    const std::vector<Plane<Number>> given = arguments();
    std::vector<Plane<Number>> results;
    std::vector<const Number*> fields;
    std::vector<Number*> targets;
    for (const Plane<Number>& plane : given) fields.push_back(plane.origin());
    results.reserve(kernel.results.size());
    for (std::size_t k = 0; k < kernel.results.size(); ++k) {
        targets.push_back(results.emplace_back(layout).origin());
    }
    compiled.run(KernelArgumentsOf<Number>{fields, {}, {}, targets, layout},
                 Patch{{0, layout.height}});
    return results;
}

template <typename Number>
std::string ProbedKernel<Number>::difference(std::size_t result, const Plane<Number>& expected,
                                             const Plane<Number>& found) const {
    using Word = WordOf<Number>;
    constexpr WordFormat format = format_of(precision_of<Number>);
    for (std::int64_t j = 0; j < grid.height; ++j) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const Word right = std::bit_cast<Word>(expected.row(j)[i]);
            const Word word = std::bit_cast<Word>(found.row(j)[i]);
            if (right == word || (format.is_nan(right) && format.is_nan(word))) continue;
            return fmt::format("{} of the words {:#x} and {:#x} is {:#x} instead of {:#x}",
                               kernel.result_names[result], words[static_cast<std::size_t>(i)],
                               words[static_cast<std::size_t>(j)], word, right);
        }
    }
    return "";
}

template struct ProbedKernel<float>;
template struct ProbedKernel<double>;

}  // namespace cascade
