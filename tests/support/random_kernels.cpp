// Makes random kernels through the builder, as the compiler does.
#include "tests/support/random_kernels.h"

#include "ir/builder.h"
#include "tests/support/random_stream.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace cascade::test {
namespace {

constexpr std::uint32_t special_words[] = {
    0x00000000, 0x80000000,                          // zeros
    0x00000001, 0x80000001, 0x007fffff, 0x807fffff,  // denormals
    0x00400000, 0x80000400,                          //
    0x00800000, 0x80800000, 0x00800001,              // the smallest normal numbers
    0x7f7fffff, 0xff7fffff,                          // the largest
    0x7f800000, 0xff800000,                          // infinities
    0x7fc00000, 0xffc00000, 0x7f800001, 0xffffffff,  // NaN
    0x3f800000, 0xbf800000, 0x40000000, 0x3f000000,  // 1, −1, 2, 1/2
    0x3f7fffff, 0x3f800001, 0x4b000000, 0x4b800000,  // the neighbours of 1; 2^23, 2^24
    0x3e000000, 0x41400000, 0x42b17218, 0xc2aeac50,  // 1/8, 12, where exp overflows and underflows
};

constexpr std::uint64_t special_long_words[] = {
    0x0000000000000000, 0x8000000000000000,                      // zeros
    0x0000000000000001, 0x8000000000000001, 0x000fffffffffffff,  // denormals
    0x800fffffffffffff, 0x0008000000000000, 0x8000000000400000,  //
    0x0010000000000000, 0x8010000000000000, 0x0010000000000001,  // the smallest normal numbers
    0x7fefffffffffffff, 0xffefffffffffffff,                      // the largest
    0x7ff0000000000000, 0xfff0000000000000,                      // infinities
    0x7ff8000000000000, 0xfff8000000000000, 0x7ff0000000000001,  // NaN
    0xffffffffffffffff, 0x3ff0000000000000, 0xbff0000000000000,  // NaN; 1, −1
    0x4000000000000000, 0x3fe0000000000000, 0x3fefffffffffffff,  // 2, 1/2; the neighbours of 1
    0x3ff0000000000001, 0x4330000000000000, 0x4340000000000000,  // 2^52, 2^53
    0x3fc0000000000000, 0x4028000000000000,                      // 1/8, 12
    0x40862e42fefa39ef, 0xc086232bdd7abcd2,  // where exp overflows and underflows
};

struct Value {
    ValueId id;
    bool is_exact = false;  ///< Whether all executors give the same bits, also if the value is NaN.
};

class Generator {
public:
    Generator(std::uint64_t seed, const RandomKernelOptions& options)
        : stream_(seed), options_(options), builder_(options.precision) {}

    CellKernel generate() && {
        for (int k = 0; k < options_.operations; ++k) step();
        for (int k = 0; k < options_.results; ++k) {
            // Most results are late values, so that most of the code is needed.
            const std::size_t last = values_.size() - 1;
            const std::size_t span = stream_.chance(80) ? 6 : last + 1;
            const std::size_t back = stream_.below(span);
            const Value value = values_[last - std::min(back, last)];
            builder_.result(fmt::format("result{}", k), value.id);
        }
        return std::move(builder_).finish();
    }

private:
    void step() {
        if (stream_.chance(options_.composed_percent)) return composed();
        Op op = static_cast<Op>(stream_.below(static_cast<std::uint64_t>(op_count)));
        if (op == Op::multiply_add && !options_.multiply_adds) op = Op::select;
        if (info(op).arity == 0) return source(op);
        if (is_link_reduction(op)) {
            return options_.links ? keep(reduction(op), false) : keep(trouble(), true);
        }
        const bool is_word_operation = op >= Op::bits_add;
        if (is_word_operation) return word_operation(op);
        const Value a = operand();
        const Value b = operand();
        if (info(op).arity == 3) {
            const Value c = operand();
            keep(builder_.apply(op, a.id, b.id, c.id),
                 op == Op::select && b.is_exact && c.is_exact);
        } else if (info(op).arity == 1) {
            const bool keeps_bits = op == Op::negate || op == Op::absolute;
            keep(builder_.apply(op, a.id), op == Op::logical_not || (keeps_bits && a.is_exact));
        } else if (op == Op::scale_by_power) {
            keep(builder_.apply(op, a.id, power_of_two()), false);
        } else {
            keep(builder_.apply(op, a.id, b.id), op >= Op::less);
        }
    }

    void source(Op op) {
        const std::uint32_t which = stream_.below(3);
        switch (op) {
            case Op::field: return keep(field(which), false);
            case Op::laplacian:
                if (!options_.laplacians) return keep(field(which), false);
                return keep(builder_.laplacian(builder_.field_slot(fmt::format("f{}", which))),
                            false);
            case Op::neighbour: {
                if (!options_.laplacians || options_.links) return keep(field(which), false);
                const auto offset = [&] { return static_cast<int>(stream_.below(3)) - 1; };
                const int dx = offset(), dy = offset(), dz = offset();
                return keep(builder_.neighbour(builder_.field_slot(fmt::format("f{}", which)), dx,
                                               dy, dz),
                            false);
            }
            case Op::link_squares:
            case Op::gradient_x:
            case Op::gradient_y:
            case Op::gradient_z:
                if (!options_.links) return keep(trouble(), true);
                return keep(builder_.over_links(op, builder_.field_slot(fmt::format("f{}", which))),
                            false);
            case Op::link_flow: {
                if (!options_.links) return keep(trouble(), true);
                const FieldSlot factor = builder_.field_slot(fmt::format("f{}", stream_.below(3)));
                const FieldSlot of = builder_.field_slot(fmt::format("f{}", which));
                return keep(builder_.link_flow({factor, of}), false);
            }
            case Op::link_weighted: {
                if (!options_.links || !options_.link_planes) return keep(trouble(), true);
                const FieldSlot weights = builder_.field_slot(fmt::format("w{}", which));
                const FieldSlot of = builder_.field_slot(fmt::format("f{}", stream_.below(3)));
                return keep(builder_.link_weighted({weights, of}), false);
            }
            case Op::theirs: {
                if (!options_.links) return keep(trouble(), true);
                constexpr Op reductions[] = {Op::link_sum, Op::link_least, Op::link_greatest};
                return keep(reduction(stream_.pick<Op>(reductions)), false);
            }
            case Op::mask:
                return keep(builder_.mask(builder_.mask_slot(fmt::format("m{}", which))), true);
            case Op::uniform:
                return keep(builder_.uniform(builder_.uniform_slot(fmt::format("u{}", which))),
                            false);
            case Op::cell_column: return keep(builder_.cell_column(), true);
            case Op::cell_row: return keep(builder_.cell_row(), true);
            case Op::cell_slice: return keep(builder_.cell_slice(), true);
            default: return keep(trouble(), true);
        }
    }

    std::uint64_t word_bits() const {
        return static_cast<std::uint64_t>(format_of(options_.precision).bits);
    }

    ValueId field(std::uint32_t which) {
        return builder_.field(builder_.field_slot(fmt::format("f{}", which)));
    }

    /// A reduction over links of a value that is computed from fields at the neighbours and other
    /// values.
    ValueId reduction(Op op) {
        constexpr Op operations[] = {Op::add,         Op::multiply, Op::divide,
                                     Op::absolute,    Op::less,     Op::square_root,
                                     Op::logical_and, Op::select,   Op::negate};
        const auto theirs = [&] {
            return builder_.theirs(builder_.field_slot(fmt::format("f{}", stream_.below(3))));
        };
        ValueId value = stream_.chance(80) ? theirs() : operand().id;
        for (std::uint32_t count = stream_.below(6); count > 0; --count) {
            const ValueId other = stream_.chance(30) ? theirs() : operand().id;
            const Op next = stream_.pick<Op>(operations);
            value = info(next).arity == 1   ? builder_.apply(next, value)
                    : info(next).arity == 2 ? builder_.apply(next, value, other)
                                            : builder_.select(other, value, operand().id);
        }
        return builder_.apply(op, value);
    }

    ValueId trouble() {
        return builder_.word(options_.precision == Precision::single ? hostile_word(stream_)
                                                                     : hostile_long_word(stream_));
    }

    /// Returns a valid exponent of 2 for scaling: a whole number from −128 to 127, or in binary64
    /// from −1024 to 1023.
    ValueId power_of_two() {
        const std::uint64_t half = options_.precision == Precision::single ? 128 : 1024;
        const ValueId word =
            builder_.apply(Op::bits_and, exact_operand(), builder_.word(2 * half - 1));
        return builder_.apply(Op::bits_to_number,
                              builder_.apply(Op::bits_subtract, word, builder_.word(half)));
    }

    void word_operation(Op op) {
        const ValueId a = exact_operand();
        if (op == Op::bits_to_number) return keep(builder_.apply(op, a), true);
        const bool is_shift = op == Op::bits_shift_left || op == Op::bits_shift_right;
        const ValueId b = is_shift ? builder_.word(stream_.below(word_bits())) : exact_operand();
        keep(builder_.apply(op, a, b), true);
    }

    void composed() {
        const ValueId a = operand().id;
        const ValueId b = operand().id;
        switch (stream_.below(25)) {
            case 0: return keep(builder_.exponential(a), false);
            case 1: return keep(builder_.logarithm(a), false);
            case 2: return keep(builder_.sine(a), false);
            case 3: return keep(builder_.cosine(a), false);
            case 4: return keep(builder_.hyperbolic_tangent(a), false);
            case 5: return keep(builder_.power(a, b), false);
            case 6:
                return keep(
                    builder_.power(a, builder_.number(static_cast<float>(stream_.below(9)) - 4.0f)),
                    false);
            case 7: return keep(builder_.random_symmetric(exact_operand(), stream_.next()), true);
            case 8: return keep(builder_.minimum(a, b), false);
            case 9: return keep(builder_.maximum(a, b), false);
            case 10: return keep(builder_.clamp_below(a, b), false);
            case 11: return keep(builder_.tangent(a), false);
            case 12: return keep(builder_.arc_sine(a), false);
            case 13: return keep(builder_.arc_cosine(a), false);
            case 14: return keep(builder_.arc_tangent(a, b), false);
            case 15: return keep(builder_.hyperbolic_sine(a), false);
            case 16: return keep(builder_.hyperbolic_cosine(a), false);
            case 17: return keep(builder_.cube_root(a), false);
            case 18: return keep(builder_.hypotenuse(a, b), false);
            case 19: return keep(builder_.sign_of(a), false);
            case 20: return keep(builder_.round_to_even(a), false);
            case 21: return keep(builder_.round_up(a), false);
            case 22: return keep(builder_.modulus(a, b), false);
            case 23: return keep(builder_.smooth_step(a, b, operand().id), false);
            default: return keep(builder_.clamp_above(a, b), false);
        }
    }

    void keep(ValueId id, bool is_exact) { values_.push_back({id, is_exact}); }

    Value operand() {
        if (values_.empty() || stream_.chance(15)) {
            return {trouble(), true};
        }
        if (stream_.chance(15)) return {field(stream_.below(3)), false};
        const bool is_recent = stream_.chance(60) && values_.size() > 8;
        const std::size_t from = is_recent ? values_.size() - 8 : 0;
        return values_[from + stream_.below(values_.size() - from)];
    }

    /// Returns a value in which NaN is replaced by 0, unless all executors give NaN the same bits.
    ValueId exact_operand() {
        const Value value = operand();
        if (value.is_exact) return value.id;
        const ValueId is_number = builder_.apply(Op::equal, value.id, value.id);
        return builder_.select(is_number, value.id, builder_.number(0));
    }

    RandomStream stream_;
    RandomKernelOptions options_;
    KernelBuilder builder_;
    std::vector<Value> values_;
};

}  // namespace

std::uint32_t hostile_word(RandomStream& stream) {
    switch (stream.below(8)) {
        case 0:
        case 1:
        case 2: return stream.pick<std::uint32_t>(special_words);
        case 3: return stream.below(64);
        case 4: return static_cast<std::uint32_t>(stream.next());
        case 5: return to_bits(stream.symmetric() * 100.0f);
        default: return to_bits(stream.symmetric() * 2.0f);
    }
}

std::uint64_t hostile_long_word(RandomStream& stream) {
    switch (stream.below(9)) {
        case 0:
        case 1:
        case 2: return stream.pick<std::uint64_t>(special_long_words);
        case 3: return stream.below(64);
        case 4: return stream.next();
        case 5: return std::bit_cast<std::uint64_t>(static_cast<double>(stream.symmetric()) * 100);
        case 6: return stream.next() >> 32;
        default: {
            const double rough = stream.symmetric();  // Has fewer digits than binary64.
            const double fine = rough + static_cast<double>(stream.symmetric()) * 0x1p-24;
            return std::bit_cast<std::uint64_t>(fine * 2);
        }
    }
}

CellKernel random_kernel(std::uint64_t seed, const RandomKernelOptions& options) {
    return Generator(seed, options).generate();
}

void OperationCounts::add(const CellKernel& kernel) {
    for (const Instruction& instruction : kernel.code) {
        ++counts[static_cast<std::size_t>(instruction.op)];
    }
}

std::string OperationCounts::missing(bool links, bool link_planes) const {
    std::string names;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const Op op = static_cast<Op>(k);
        const bool is_foreign = (op == Op::multiply_add && !has_multiply_add()) ||
                                (op == Op::link_weighted && !link_planes) ||
                                (links ? op == Op::neighbour
                                       : (is_link_sum(op) && op != Op::laplacian) ||
                                             is_link_reduction(op) || op == Op::theirs);
        if (counts[k] != 0 || is_foreign) continue;
        names += fmt::format("{}{}", names.empty() ? "" : " ", info(static_cast<Op>(k)).name);
    }
    return names;
}

std::string OperationCounts::report() const {
    std::string text;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        text += fmt::format("{:>9} {}\n", counts[k], info(static_cast<Op>(k)).name);
    }
    return text;
}

}  // namespace cascade::test
