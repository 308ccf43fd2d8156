// Builds cell kernels. Every method returns the value of a new or an existing instruction: the
// builder folds constants (in the spec's environment, as the interpreter evaluates operations) and
// numbers values, so an unsimplified kernel never exists.
//
// It only uses identities that hold for every word (select with equal branches or a constant
// condition, `and` and `or` with a constant). x * 1 and x + 0 are NOT among them: they flush
// denormals and lose −0.
//
// Elementary functions are expanded here into operations of the table, so that every executor
// computes the same bits (ir/elementary.cpp and spec/numerics.md state their accuracy).
#pragma once

#include "ir/cell_kernel.h"

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace cascade {

/// Whether equal products and quotients are one value. In a kernel to be contracted they are
/// several, so that keep() excludes only one of them. contracted() makes them one.
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

    // Sources. Slots are created at first use. The same name gives the same slot.
    ValueId number(double value);      ///< Rounded to the kernel's precision. Denormals become 0.
    ValueId word(std::uint64_t bits);  ///< Modulo 2^32 or 2^64.
    FieldSlot field_slot(const std::string& name);
    MaskSlot mask_slot(const std::string& name);
    UniformSlot uniform_slot(const std::string& name);
    ValueId field(FieldSlot slot);
    ValueId laplacian(FieldSlot slot);
    /// The value of a field in a neighbouring cell. Each offset is −1, 0 or 1, and all may be 0.
    ValueId neighbour(FieldSlot slot, int dx, int dy, int dz = 0);
    /// A sum over a cell's links of differences of one field. Only in a kernel for a surface.
    ValueId over_links(Op op, FieldSlot slot);
    ValueId link_flow(Flow flow);
    /// The value of a field in the cell to which a link leads. Must be inside a reduction.
    ValueId theirs(FieldSlot slot);
    /// Reductions over a cell's links, only in a kernel for linked cells. `a` may be a value of
    /// links or of cells.
    ValueId link_sum(ValueId a) { return apply(Op::link_sum, a); }
    ValueId link_least(ValueId a) { return apply(Op::link_least, a); }
    ValueId link_greatest(ValueId a) { return apply(Op::link_greatest, a); }
    ValueId mask(MaskSlot slot);
    ValueId uniform(UniformSlot slot);
    ValueId cell_column();
    ValueId cell_row();
    ValueId cell_slice();

    /// Emits any instruction of the table.
    ValueId emit(Instruction instruction);
    /// Emits any operation of the table without payload.
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
    // b if b is NaN, else the smaller (larger), b if they are equal. `clamp_below(x, bound)`
    // enforces x >= bound: it is bound if x < bound, else x (so NaN stays NaN). `clamp_above`
    // likewise.
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
    /// The angle of the point (x, y), −π … π. The arc tangent of y is the angle of (1, y).
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
    /// x − y · floor(x / y), with the sign of y; NaN if |x / y| is 2^24 (in binary64 2^52) or more.
    ValueId modulus(ValueId x, ValueId y);
    /// 0 up to `low`, 1 from `high` on, 3 t² − 2 t³ between them.
    ValueId smooth_step(ValueId low, ValueId high, ValueId x);
    /// x^y. A constant integer y of magnitude at most 64 becomes multiplications by repeated
    /// squaring (in the order of the spec), and 1/x^n if negative. Other y use log and exp.
    ValueId power(ValueId x, ValueId y);

    // Random numbers (ir/random_numbers.cpp).
    /// Makes draws use this cell number, a word, instead of the cell's column and row.
    void set_cell(ValueId number) { cell_ = number; }
    /// The two words that identify the cell in draws.
    std::pair<ValueId, ValueId> cell_of_draws() {
        return cell_ ? std::pair(*cell_, word(0)) : std::pair(cell_column(), cell_row());
    }
    /// Uniform in (−1, 1), symmetric, with 2^23 different values. In binary64 it has 2^52, whose
    /// first digits are the same. A pure function of the cell, the `draw` word (the step, or 0) and
    /// the 64-bit `key` (seed, stage, parameter, occurrence).
    ValueId random_symmetric(ValueId draw, std::uint64_t key);
    /// The 32-bit word in a uniform made by draw_uniform() (ir/draw_of_step.h).
    ValueId draw_word(ValueId uniform);
    /// Gaussian with mean 0 and variance 1, of magnitude at most 6.7, with the same arguments.
    ValueId random_normal(ValueId draw, std::uint64_t key);

    /// Excludes this product or quotient from contraction.
    void keep(ValueId id) { kernel_.kept.push_back(id); }
    /// Excludes all values from this one on.
    void keep_from(ValueId first) {
        for (ValueId id = first; id < next(); ++id) keep(id);
    }

    /// Appends an output.
    void result(const std::string& name, ValueId value);

    /// The finished kernel, without instructions that no result needs. Unused slots stay.
    CellKernel finish() &&;

    /// The next new value.
    ValueId next() const { return kernel_.code.next(); }
    const Instruction& operator[](ValueId id) const { return kernel_.code[id]; }
    bool is_constant(ValueId id) const { return kernel_.code[id].op == Op::constant; }
    /// The number that a constant represents.
    double constant(ValueId id) const { return number_of(kernel_.code[id].payload, precision()); }

private:
    std::optional<ValueId> simplify(const Instruction& instruction);
    std::optional<ValueId> simplify_logic(Op op, ValueId x, std::uint64_t known);
    bool is_true_word(std::uint64_t word) const;
    ValueId fold(const Instruction& instruction);

    CellKernel kernel_;
    std::optional<ValueId> cell_;  ///< Used for draws if set.
    EqualProducts products_;
    std::unordered_map<std::uint64_t, ValueId> numbering_;  ///< By hash, with linear probing.
    std::unordered_map<std::string, FieldSlot> field_slots_;
    std::unordered_map<std::string, MaskSlot> mask_slots_;
    std::unordered_map<std::string, UniformSlot> uniform_slots_;
};

}  // namespace cascade
