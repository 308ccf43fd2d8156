// Computes each operation on pairs of difficult words, by a printed kernel and by the interpreter.
#include "device/probe.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "device/build_options.h"
#include "device/kernel_text.h"
#include "ir/builder.h"
#include "ir/interpreter.h"
#include "ir/multiply_add.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <vector>

namespace cascade {
namespace {

/// Words for which inexact devices give wrong results. Each is combined with each.
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
    // Numbers with dense digits and with exponents at both ends, for quotients and roots.
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
    // A compiler that does not consider flushing replaces these by a.
    builder.result("a * 1", builder.multiply(a, builder.number(1)));
    builder.result("a + -0", builder.add(a, builder.word(builder.format().sign())));
    builder.result("least", builder.select(builder.apply(Op::less, a, b), a, b));
    return std::move(builder).finish();
}

template <typename Number>
class Probe {
    using Word = WordOf<Number>;

public:
    Probe(OpenDevice& device, const TextTarget& target)
        : device_(device),
          target_(target),
          kernel_(probing_kernel(precision_of<Number>)),
          words_(hard_words<Number>()),
          grid_{static_cast<std::int64_t>(words_.size()), static_cast<std::int64_t>(words_.size())},
          layout_(grid_) {}

    /// Describes the first difference; empty if there is none.
    std::string fault() {
        std::vector<Plane<Number>> given = arguments();
        const DeviceProgram built =
            device_.build(text(given.size()), build_options(target_, device_.facts()));
        const std::size_t bytes = Plane<Number>::bytes(layout_);
        const DeviceBuffer planes = device_.buffer(bytes * (given.size() + kernel_.results.size()));
        for (std::size_t k = 0; k < given.size(); ++k) {
            device_.write(planes, bytes * k, memory_of(given[k]), bytes);
        }
        DeviceKernel run = built.kernel("c_probe");
        const auto columns = static_cast<std::size_t>((layout_.width + 15) / 16 * 16);
        const auto rows = static_cast<std::int32_t>(layout_.height);
        run.set(planes, Word{0}, std::int32_t{0}, rows);
        device_.launch(run, columns, static_cast<std::size_t>(rows), 16);
        const std::vector<Plane<Number>> expected = interpreted(given);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            Plane<Number> found(layout_);
            device_.read(planes, bytes * (given.size() + k), memory_of(found), bytes);
            const std::string fault = difference(k, expected[k], found);
            if (!fault.empty()) return fault;
        }
        return "";
    }

private:
    Number* memory_of(Plane<Number>& plane) const { return plane.origin() - layout_.offset(0, 0); }

    std::vector<Plane<Number>> arguments() const {
        std::vector<Plane<Number>> planes;
        for (int k = 0; k < 2; ++k) planes.emplace_back(layout_);
        for (std::int64_t j = 0; j < layout_.height; ++j) {
            for (std::int64_t i = 0; i < layout_.width; ++i) {
                planes[0].row(j)[i] = std::bit_cast<Number>(words_[static_cast<std::size_t>(i)]);
                planes[1].row(j)[i] = std::bit_cast<Number>(words_[static_cast<std::size_t>(j)]);
            }
        }
        return planes;
    }

    std::string text(std::size_t fields) const {
        KernelNames names;
        std::int64_t place = layout_.offset(0, 0);
        const auto plane = [&] {
            const std::string name = fmt::format("c_planes + {}", place);
            place += layout_.size();
            return name;
        };
        for (std::size_t k = 0; k < fields; ++k) names.fields.push_back(plane());
        for (std::size_t k = 0; k < kernel_.results.size(); ++k) names.results.push_back(plane());
        const Stencil stencil = grid_.stencil();
        return prelude_text(target_) + stencil_text(target_, stencil, layout_) +
               "__kernel void c_probe(__global cw* c_planes, const cw c_pad, "
               "const int c_first_row, const int c_last_row) {\n" +
               cells_begin(target_, stencil, layout_, 1) +
               cell_text(kernel_, names, target_, stencil, layout_) + std::string(cells_end) +
               "}\n";
    }

    std::vector<Plane<Number>> interpreted(std::vector<Plane<Number>>& given) const {
        std::vector<Plane<Number>> results;
        std::vector<const Number*> fields;
        std::vector<Number*> targets;
        for (const Plane<Number>& plane : given) fields.push_back(plane.origin());
        results.reserve(kernel_.results.size());
        for (std::size_t k = 0; k < kernel_.results.size(); ++k) {
            targets.push_back(results.emplace_back(layout_).origin());
        }
        const FlushDenormals environment;
        const auto interpreter = make_interpreter();
        const KernelPointer kernel = interpreter->find(kernel_, grid_.stencil());
        kernel->run(KernelArgumentsOf<Number>{fields, {}, {}, targets, layout_},
                    Patch{{0, layout_.height}});
        return results;
    }

    std::string difference(std::size_t result, const Plane<Number>& expected,
                           const Plane<Number>& found) const {
        constexpr WordFormat format = format_of(precision_of<Number>);
        for (std::int64_t j = 0; j < layout_.height; ++j) {
            for (std::int64_t i = 0; i < layout_.width; ++i) {
                const Word right = std::bit_cast<Word>(expected.row(j)[i]);
                const Word word = std::bit_cast<Word>(found.row(j)[i]);
                if (right == word || (format.is_nan(right) && format.is_nan(word))) continue;
                return fmt::format("{} of the words {:#x} and {:#x} is {:#x} instead of {:#x}",
                                   kernel_.result_names[result],
                                   words_[static_cast<std::size_t>(i)],
                                   words_[static_cast<std::size_t>(j)], word, right);
            }
        }
        return "";
    }

    OpenDevice& device_;
    TextTarget target_;
    CellKernel kernel_;
    std::vector<Word> words_;
    Grid grid_;
    PlaneLayout layout_;
};

}  // namespace

ProbeResult probe(OpenDevice& device, Precision precision) {
    ProbeResult result;
    result.target.precision = precision;
    result.target.has_fast_fma = device.facts().has_fast_fma;
    if (precision == Precision::binary64 && !device.facts().has_double) {
        result.fault = "it has no double precision";
        return result;
    }
    for (const Flushing flushing : {Flushing::by_device, Flushing::by_kernel}) {
        result.target.flushing = flushing;
        result.fault = with_number(precision, [&](auto zero) {
            return Probe<decltype(zero)>(device, result.target).fault();
        });
        if (result.is_exact()) return result;
    }
    return result;
}

}  // namespace cascade
