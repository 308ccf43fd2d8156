// Builds cell kernels. Every method returns the value of a new instruction, or of an equal
// instruction that exists already. An operation on constants is evaluated at once, as the
// interpreter would evaluate it, with denormals flushed. So every kernel is simplified from the
// beginning.
//
// The builder simplifies only by identities that hold for every word. It simplifies a select with
// equal branches or a constant condition, and an `and` or `or` with a constant. x * 1 and x + 0 are
// NOT simplified, because they flush denormals and turn −0 into 0.
//
// Elementary functions are expanded here into operations of ir/operations.def, so that every
// executor computes the same bits. spec/numerics.md states their accuracy.
#pragma once

#include "ir/cell_kernel.h"

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace cascade {

/// Whether equal products become one value, and likewise equal quotients. In a kernel that will be
/// contracted they must stay separate, so that keep() can exclude one of several equal products
/// from contraction. contracted() then merges the equal values.
enum class EqualProducts : std::uint8_t { are_one, are_several };

class KernelBuilder {
public:
    explicit KernelBuilder(Precision precision = Precision::single,
                           EqualProducts products = EqualProducts::are_one)
        : products_(products) {
        kernel_.precision = precision;
    }
    Precision precision() const { return kernel_.precision; }
    WordFormat format() const { return format_of(kernel_.precision); }

    // Sources. A slot is created when its name is first used. Using the name again gives the same
    // slot.
    ValueId number(double value);      ///< Rounded to the kernel's precision. Denormals become 0.
    ValueId word(std::uint64_t bits);  ///< Modulo 2^32 or 2^64.
    FieldSlot field_slot(const std::string& name);
    MaskSlot mask_slot(const std::string& name);
    UniformSlot uniform_slot(const std::string& name);
    ValueId field(FieldSlot slot);
    ValueId laplacian(FieldSlot slot);
    /// The value of a field in a neighbouring cell. Each offset is −1, 0 or 1, and all may be 0.
    ValueId neighbour(FieldSlot slot, int dx, int dy, int dz = 0);
    /// The sum, over a cell's links, of the differences of one field. Only in a kernel for linked
    /// cells.
    ValueId over_links(Op op, FieldSlot slot);
    ValueId link_flow(Flow flow);
    /// The sum, over a cell's links, of the differences of the field `flow.of`. Each difference is
    /// multiplied by the number that the field `flow.factor` has for the link.
    ValueId link_weighted(Flow flow);
    /// The value of a field in the cell to which a link leads. Must be inside a reduction.
    ValueId theirs(FieldSlot slot);
    /// Reductions over a cell's links, only in a kernel for linked cells. `a` is a value of links
    /// or a value of cells. A value of cells is the same for all links of a cell.
    ValueId link_sum(ValueId a) { return apply(Op::link_sum, a); }
    ValueId link_least(ValueId a) { return apply(Op::link_least, a); }
    ValueId link_greatest(ValueId a) { return apply(Op::link_greatest, a); }
    ValueId mask(MaskSlot slot);
    ValueId uniform(UniformSlot slot);
    ValueId cell_column();
    ValueId cell_row();
    ValueId cell_slice();

    /// Emits an instruction with any operation of ir/operations.def.
    ValueId emit(Instruction instruction);
    /// Emits an operation without payload.
    ValueId apply(Op op, ValueId a);
    ValueId apply(Op op, ValueId a, ValueId b);
    ValueId apply(Op op, ValueId a, ValueId b, ValueId c);

    ValueId select(ValueId condition, ValueId then, ValueId otherwise) {
        return apply(Op::select, condition, then, otherwise);
    }
    ValueId add(ValueId a, ValueId b) { return apply(Op::add, a, b); }
    ValueId subtract(ValueId a, ValueId b) { return apply(Op::subtract, a, b); }
    ValueId multiply(ValueId a, ValueId b) { return apply(Op::multiply, a, b); }
    ValueId divide(ValueId a, ValueId b) { return apply(Op::divide, a, b); }

    // Composed operations. `minimum` and `maximum` propagate NaN: the result is a if a is NaN, else
    // b if b is NaN, else the smaller (larger) number, or b if they are equal. `clamp_below(x,
    // bound)` enforces x >= bound: the result is bound if x < bound, else x, so NaN stays NaN.
    // `clamp_above(x, bound)` enforces x <= bound in the same way.
    ValueId minimum(ValueId a, ValueId b);
    ValueId maximum(ValueId a, ValueId b);
    ValueId clamp_below(ValueId x, ValueId bound);
    ValueId clamp_above(ValueId x, ValueId bound);

    // Elementary functions (ir/elementary.cpp, trigonometric.cpp, inverse_trigonometric.cpp,
    // roots.cpp, rounding.cpp).
    ValueId exponential(ValueId x);
    ValueId logarithm(ValueId x);
    ValueId sine(ValueId x);
    ValueId cosine(ValueId x);
    ValueId tangent(ValueId x);
    ValueId arc_sine(ValueId x);
    ValueId arc_cosine(ValueId x);
    /// The angle of the point (x, y), −π … π. So the arc tangent of y is arc_tangent(y, 1).
    ValueId arc_tangent(ValueId y, ValueId x);
    ValueId hyperbolic_sine(ValueId x);
    ValueId hyperbolic_cosine(ValueId x);
    ValueId hyperbolic_tangent(ValueId x);
    ValueId cube_root(ValueId x);
    ValueId hypotenuse(ValueId x, ValueId y);
    ValueId sign_of(ValueId x);        ///< −1, 1, or x if it is zero or NaN.
    ValueId round_to_even(ValueId x);  ///< The nearest integer, ties to even.
    ValueId round_down(ValueId x);
    ValueId round_up(ValueId x);
    /// x − y · floor(x / y), with the sign of y; NaN if |x / y| is at least 2^24 (in binary64 at
    /// least 2^52).
    ValueId modulus(ValueId x, ValueId y);
    /// 0 for x up to `low`, 1 from `high` on. Between them 3 t² − 2 t³, where t = (x − low) / (high
    /// − low).
    ValueId smooth_step(ValueId low, ValueId high, ValueId x);
    /// x^y. A constant integer y of magnitude at most 64 becomes multiplications by repeated
    /// squaring (in the order that spec/numerics.md gives), followed by a division 1 / x^|y| if y
    /// is negative. Any other y uses log and exp.
    ValueId power(ValueId x, ValueId y);

    // Random numbers (ir/random_numbers.cpp).

    /// Later random numbers depend on the word `number` instead of the cell's column and row.
    void set_cell(ValueId number) { cell_ = number; }
    /// The two words that identify the cell when random numbers are drawn.
    std::pair<ValueId, ValueId> cell_of_draws() {
        return cell_ ? std::pair(*cell_, word(0)) : std::pair(cell_column(), cell_row());
    }
    /// A random number in (−1, 1), uniform and symmetric. There are 2^23 different values in
    /// binary32, and 2^52 in binary64. The binary64 number begins with the digits of the binary32
    /// number. The number depends only on the cell, the `draw` word (the step, or 0) and the 64-bit
    /// `key` (seed, stage, parameter, occurrence).
    ValueId random_symmetric(ValueId draw, std::uint64_t key);
    /// Reads the 32-bit draw word that draw_uniform() (ir/draw_of_step.h) stored in a uniform.
    ValueId draw_word(ValueId uniform);
    /// A Gaussian random number with mean 0, variance 1 and a magnitude of at most 6.7. It depends
    /// on the same words as random_symmetric().
    ValueId random_normal(ValueId draw, std::uint64_t key);

    /// Excludes this product or quotient from contraction (ir/contraction.h).
    void keep(ValueId id) { kernel_.kept.push_back(id); }
    /// Excludes `first` and all values after it from contraction.
    void keep_from(ValueId first) {
        for (ValueId id = first; id < next(); ++id) keep(id);
    }

    /// Appends an output of the kernel.
    void result(const std::string& name, ValueId value);

    /// The finished kernel, without instructions that no result needs. Unused slots remain.
    CellKernel finish() &&;

    /// The id that the next new value will have.
    ValueId next() const { return kernel_.code.next(); }
    const Instruction& operator[](ValueId id) const { return kernel_.code[id]; }
    bool is_constant(ValueId id) const { return kernel_.code[id].op == Op::constant; }
    /// The number in the constant `id`. The value `id` must be a constant.
    double constant(ValueId id) const { return number_of(kernel_.code[id].payload, precision()); }

private:
    std::optional<ValueId> simplify(const Instruction& instruction);
    std::optional<ValueId> simplify_logic(Op op, ValueId x, std::uint64_t known);
    bool is_true_word(std::uint64_t word) const;
    ValueId fold(const Instruction& instruction);

    CellKernel kernel_;
    /// If set, random numbers depend on this word and not on the cell's column and row.
    std::optional<ValueId> cell_;
    EqualProducts products_;
    /// Maps the hash of each instruction to its value, with linear probing.
    std::unordered_map<std::uint64_t, ValueId> numbering_;
    std::unordered_map<std::string, FieldSlot> field_slots_;
    std::unordered_map<std::string, MaskSlot> mask_slots_;
    std::unordered_map<std::string, UniformSlot> uniform_slots_;
};

}  // namespace cascade
