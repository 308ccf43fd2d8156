// Loops over the links of cells (core/links.h). One loop over the entries of a slice computes all
// sums of the kernel for all vectors of a group. Reductions have further loops, separate for each
// vector.
#include "wasm/cells.h"

#include "core/links.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

namespace cascade::wasm {
namespace {

constexpr int slice_cells = LinkTable<float>::slice_cells;
constexpr int slice_shift = 4;
static_assert(1 << slice_shift == slice_cells);

/// Identifies a sum over links by its operation and payload.
using SumKey = std::pair<Op, std::uint64_t>;
SumKey key_of(const Instruction& instruction) { return {instruction.op, instruction.payload}; }

/// The array of numbers by which a sum multiplies its differences: a parameter, or the plane of a
/// field that has a number for each link.
using Weights = std::variant<Parameter, FieldSlot>;
Weights weights_of(const SumKey& key) {
    switch (key.first) {
        case Op::gradient_x: return Parameter::gradient_x;
        case Op::gradient_y: return Parameter::gradient_y;
        case Op::gradient_z: return Parameter::gradient_z;
        case Op::link_weighted: return Flow::with(key.second).factor;
        default: return Parameter::weights;
    }
}

class LinkedCells final : public Cells {
public:
    using Cells::Cells;

    void begin_group(int vectors) override;
    Local laplacian(FieldSlot slot) override { return sum({Op::laplacian, slot.index()}); }
    Local link_sum(const Instruction& instruction) override { return sum(key_of(instruction)); }
    void begin_links() override;
    void end_links() override;
    Local theirs(FieldSlot slot) override;
    Local is_link() override;

private:
    using LocalBySlot = std::map<FieldSlot, Local>;

    /// The locals of one vector of the group. They are valid in all entries.
    struct Vector {
        std::map<SumKey, Local> sums;
        LocalBySlot own;  ///< The fields' values in the cells themselves.
    };

    Local sum(const SumKey& key) const { return vectors_.at(vector_).sums.at(key); }
    void begin_sums(Vector& vector);
    void find_links();
    Local address(Weights array, Local element, int shift);
    void begin_entry();
    void end_vector_of_entry();
    void add_entry();
    void advance(Local address, int bytes);
    void find_targets();
    void push_term(const SumKey& key);
    Local base_of(FieldSlot slot);
    Local own(FieldSlot slot) const { return vectors_.at(vector_).own.at(slot); }
    Local at_targets(FieldSlot slot);
    Local difference(FieldSlot slot);
    Local factors(Weights array);

    Code& links() { return function_.at(LoopLevel::link); }
    Arithmetic arithmetic_of_links() { return {function_, LoopLevel::link, is_exact_}; }
    /// Moves the top of the stack, in code of links, to a local that is valid until the end of the
    /// entry.
    Local keep_in_entry(LocalType type = LocalType::vector) {
        of_entry_.push_back(function_.keep(LoopLevel::link, type));
        return of_entry_.back();
    }
    /// Moves the top of the stack to a local that is valid until the end of the loop.
    Local keep_in_loop() {
        of_loop_.push_back(function_.keep(LoopLevel::cell, LocalType::integer));
        return of_loop_.back();
    }

    std::map<int, Vector> vectors_;  ///< By the index of the vector in the group.
    // Locals of the loop: the addresses of the entry's data, and the end of the addresses of bases.
    std::vector<Local> of_loop_;
    Local base_at_{}, bases_end_{}, offsets_at_{}, filled_at_{};
    Local lane_{};  ///< The lane, in its slice, of the group's first cell.
    Local link_{};  ///< The index of the first link of that cell.
    std::map<Weights, Local> factors_at_;
    // Locals of the entry.
    std::vector<Local> of_entry_;
    Local base_{};  ///< The position from which offsets are counted, in bytes from cell (0, 0).
    LocalBySlot bases_of_fields_;  ///< The addresses from which offsets are counted.
    // Locals of the vector in the entry.
    std::vector<Local> targets_;  ///< For each lane, the distance in bytes from `base_`.
    std::optional<Local> is_link_;
    LocalBySlot fields_, operands_, differences_;
    std::map<Weights, Local> factors_;
};

void LinkedCells::begin_group(int vectors) {
    const bool has_sums = std::any_of(kernel_.code.begin(), kernel_.code.end(),
                                      [](const auto& each) { return is_link_sum(each.op); });
    if (!has_sums) return;
    for (int vector = 0; vector < vectors; ++vector) {
        begin_vector(vector);
        begin_sums(vectors_[vector]);
        end_vector();
    }
    find_links();
    for (const auto& [key, sum] : vectors_.at(0).sums) {
        const Weights array = weights_of(key);
        if (factors_at_.contains(array)) continue;
        factors_at_[array] = address(array, link_, function_.number_shift());
    }
    add_entry();
    end_links();
}

/// Sets the sums to 0, and loads the cells' own values that the terms of the sums need.
void LinkedCells::begin_sums(Vector& vector) {
    const auto load_own = [&](FieldSlot slot) {
        if (vector.own.contains(slot)) return;
        code().get(operand({slot}));
        vector.own[slot] = function_.keep(LoopLevel::cell);
    };
    for (const Instruction& instruction : kernel_.code) {
        const SumKey key = key_of(instruction);
        if (!is_link_sum(instruction.op) || vector.sums.contains(key)) continue;
        code().get(function_.constant(0));
        vector.sums[key] = function_.keep(LoopLevel::cell);
        const Flow flow = Flow::with(instruction.payload);
        load_own(flow.of);
        if (instruction.op == Op::link_flow) load_own(flow.factor);
    }
}

/// Finds the addresses of the data of the slice's first entry. If the group's first cell is in
/// column c, its slice is number c / 16 of the row, and its lane in the slice is c mod 16.
void LinkedCells::find_links() {
    const int vector = std::exchange(vector_, 0);
    push_column();
    begin_vector(vector);
    const Local column = keep_in_loop();
    // The stride is the width of all slices of a row, plus one slice of padding on each side.
    code().get(local_of(Parameter::stride));
    code().integer(slice_shift);
    code().write(Plain::shift_right);
    code().integer(2);
    code().write(Plain::subtract);
    code().get(local_of(Parameter::row_begin));
    code().write(Plain::multiply);
    code().get(column);
    code().integer(slice_shift);
    code().write(Plain::shift_right);
    code().write(Plain::add);
    const Local slice = keep_in_loop();
    const Local start = address(Parameter::starts, slice, 2);
    const auto entry_at = [&](std::uint32_t slices_after) {
        code().get(start);
        code().access(Plain::load, 4 * slices_after);
        return keep_in_loop();
    };
    const Local entry = entry_at(0), last = entry_at(1);
    base_at_ = address(Parameter::bases, entry, 2);
    bases_end_ = address(Parameter::bases, last, 2);
    filled_at_ = address(Parameter::filled, entry, 1);
    code().get(column);
    code().integer(slice_cells - 1);
    code().write(Plain::bits_and);
    lane_ = keep_in_loop();
    code().get(entry);
    code().integer(slice_shift);
    code().write(Plain::shift_left);
    code().get(lane_);
    code().write(Plain::add);
    link_ = keep_in_loop();
    offsets_at_ = address(Parameter::offsets, link_, 1);
}

/// The address of an element of an array whose elements have 2^shift bytes.
Local LinkedCells::address(Weights array, Local element, int shift) {
    const auto* const slot = std::get_if<FieldSlot>(&array);
    code().get(slot != nullptr ? plane(Parameter::fields, slot->index())
                               : local_of(std::get<Parameter>(array)));
    code().get(element);
    code().integer(shift);
    code().write(Plain::shift_left);
    code().write(Plain::add);
    return keep_in_loop();
}

void LinkedCells::advance(Local address, int bytes) {
    links().get(address);
    links().integer(bytes);
    links().write(Plain::add);
    links().set(address);
}

void LinkedCells::begin_links() {
    find_links();
    begin_entry();
}

/// Writes a loop whose body is the code of links written so far.
void LinkedCells::end_links() {
    end_vector_of_entry();
    for (const Local local : of_entry_) function_.give_back(local, LoopLevel::link);
    of_entry_.clear();
    bases_of_fields_.clear();
    advance(base_at_, 4);
    advance(filled_at_, 2);
    advance(offsets_at_, 2 * slice_cells);
    for (const auto& [array, address] : factors_at_) {
        advance(address, slice_cells * function_.number_bytes());
    }
    code().open(Plain::block);
    code().get(base_at_);
    code().get(bases_end_);
    code().write(Plain::greater_equal_unsigned);
    code().branch_if();
    code().open(Plain::loop);
    code().write(links());
    links().clear();
    code().get(base_at_);
    code().get(bases_end_);
    code().write(Plain::less_unsigned);
    code().branch_if();
    code().close();
    code().close();
    for (const Local local : of_loop_) function_.give_back(local);
    of_loop_.clear();
    factors_at_.clear();
}

void LinkedCells::begin_entry() {
    links().get(base_at_);
    links().access(Plain::load, 0);
    links().integer(function_.number_shift());
    links().write(Plain::shift_left);
    base_ = keep_in_entry(LocalType::integer);
}

void LinkedCells::end_vector_of_entry() {
    targets_.clear();
    is_link_.reset();
    fields_.clear();
    operands_.clear();
    differences_.clear();
    factors_.clear();
}

void LinkedCells::add_entry() {
    begin_entry();
    for (const auto& [number, vector] : vectors_) {
        begin_vector(number);
        for (const auto& [key, sum] : vector.sums) {
            links().get(sum);
            push_term(key);
            arithmetic_of_links().add();
            links().set(sum);
        }
        end_vector_of_entry();
    }
}

void LinkedCells::find_targets() {
    for (int lane = 0; lane < function_.lanes(); ++lane) {
        const int link = vector_ * function_.lanes() + lane;
        links().get(offsets_at_);
        links().access(Plain::load_16_signed, static_cast<std::uint32_t>(2 * link));
        links().integer(function_.number_shift());
        links().write(Plain::shift_left);
        targets_.push_back(keep_in_entry(LocalType::integer));
    }
}

Local LinkedCells::is_link() {
    if (!is_link_) {
        links().get(filled_at_);
        links().access(Plain::load_16_signed, 0);
        links().get(lane_);
        links().integer(vector_ * function_.lanes());
        links().write(Plain::add);
        links().write(Plain::shift_right);
        splat_word(links());
        links().get(function_.lane_bits());
        links().write(Whole::bits_and);
        links().get(function_.constant(0));
        links().write(Lanes::word_not_equal);
        is_link_ = keep_in_entry();
    }
    return *is_link_;
}

/// Pushes the term that the entry adds to a sum.
void LinkedCells::push_term(const SumKey& key) {
    const auto [op, payload] = key;
    const Flow flow = Flow::with(payload);
    links().get(factors(weights_of(key)));
    if (op == Op::link_flow) {
        links().get(at_targets(flow.factor));
        links().get(own(flow.factor));
        arithmetic_of_links().add();
    }
    links().get(difference(flow.of));
    if (op == Op::link_squares) links().get(difference(flow.of));
    if (op == Op::link_flow || op == Op::link_squares) arithmetic_of_links().multiply();
    arithmetic_of_links().multiply();
}

/// The address in a field's plane from which the entry's offsets are counted, minus pad_bytes().
Local LinkedCells::base_of(FieldSlot slot) {
    const auto [known, is_new] = bases_of_fields_.try_emplace(slot);
    if (is_new) {
        links().get(plane(Parameter::fields, slot.index()));
        links().get(base_);
        links().write(Plain::add);
        known->second = keep_in_entry(LocalType::integer);
    }
    return known->second;
}

Local LinkedCells::theirs(FieldSlot slot) {
    if (targets_.empty()) find_targets();
    const auto [known, is_new] = fields_.try_emplace(slot);
    if (!is_new) return known->second;
    const Local base = base_of(slot);
    for (int lane = 0; lane < function_.lanes(); ++lane) {
        links().get(base);
        links().get(targets_[static_cast<std::size_t>(lane)]);
        links().write(Plain::add);
        if (lane == 0) {
            links().access(Lanes::load_first, pad_bytes());
            known->second = keep_in_entry();
        } else {
            links().get(known->second);
            links().access(Lanes::load_lane, pad_bytes(), lane);
            links().set(known->second);
        }
    }
    return known->second;
}

/// Does the same as theirs(), but flushes the values in exact kernels, for use as operands of
/// arithmetic.
Local LinkedCells::at_targets(FieldSlot slot) {
    if (!is_exact_) return theirs(slot);
    const auto [known, is_new] = operands_.try_emplace(slot);
    if (is_new) {
        links().get(theirs(slot));
        arithmetic_of_links().flush();
        known->second = keep_in_entry();
    }
    return known->second;
}

/// The difference f_j − f_i of a field's values in the cell j to which the link leads and in the
/// cell i itself.
Local LinkedCells::difference(FieldSlot slot) {
    const auto [known, is_new] = differences_.try_emplace(slot);
    if (is_new) {
        links().get(at_targets(slot));
        links().get(own(slot));
        arithmetic_of_links().subtract();
        known->second = keep_in_entry();
    }
    return known->second;
}

Local LinkedCells::factors(Weights array) {
    const auto [known, is_new] = factors_.try_emplace(array);
    if (is_new) {
        // Addresses of planes are reduced by pad_bytes().
        const bool is_plane = std::holds_alternative<FieldSlot>(array);
        const auto offset = static_cast<std::uint32_t>(vector_ * Code::vector_bytes);
        links().get(factors_at_.at(array));
        links().access(Whole::load, offset + (is_plane ? pad_bytes() : 0));
        arithmetic_of_links().flush();
        known->second = keep_in_entry();
    }
    return known->second;
}

}  // namespace

std::unique_ptr<Cells> make_linked_cells(Function& function, const CellKernel& kernel, Place place,
                                         bool is_exact) {
    return std::make_unique<LinkedCells>(function, kernel, Stencil::linked, place, is_exact);
}

}  // namespace cascade::wasm
