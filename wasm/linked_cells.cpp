// Sums over the links of cells (core/links.h): one loop over the entries of a slice computes all
// sums of the kernel for all vectors of a group.
#include "wasm/cells.h"

#include "core/links.h"

#include <algorithm>
#include <utility>

namespace cascade::wasm {
namespace {

constexpr int slice_cells = LinkTable<float>::slice_cells;
constexpr int slice_shift = 4;
static_assert(1 << slice_shift == slice_cells);

/// A sum of a kernel, by what tells it from others.
using SumKey = std::pair<Op, std::uint64_t>;
SumKey key_of(const Instruction& instruction) { return {instruction.op, instruction.payload}; }

Parameter weights_of(Op op) {
    switch (op) {
        case Op::gradient_x: return Parameter::gradient_x;
        case Op::gradient_y: return Parameter::gradient_y;
        case Op::gradient_z: return Parameter::gradient_z;
        default: return Parameter::weights;
    }
}

class LinkedCells final : public Cells {
public:
    using Cells::Cells;

    void begin_group(int vectors) override;
    Local laplacian(FieldSlot slot) override { return sum({Op::laplacian, slot.index()}); }
    Local link_sum(const Instruction& instruction) override { return sum(key_of(instruction)); }

private:
    using LocalBySlot = std::map<FieldSlot, Local>;

    /// What a vector of the group has, in all entries.
    struct Vector {
        std::map<SumKey, Local> sums;
        LocalBySlot own;  ///< What fields hold in the cells themselves.
    };

    Local sum(const SumKey& key) const { return vectors_.at(vector_).sums.at(key); }
    void begin_sums(Vector& vector);
    void find_links();
    void push_address(Parameter array, Local element, int shift);
    void add_entry();
    void advance(Local address, int bytes);
    void find_targets();
    void push_term(const SumKey& key);
    Local own(FieldSlot slot) const { return vectors_.at(vector_).own.at(slot); }
    Local at_targets(FieldSlot slot);
    Local difference(FieldSlot slot);
    Local factors(Parameter array);

    /// What is on top of the stack, until the end of the entry.
    Local keep_in_entry(LocalType type = LocalType::vector) {
        of_entry_.push_back(function_.keep(LoopLevel::cell, type));
        return of_entry_.back();
    }
    Local keep_address() { return function_.keep(LoopLevel::cell, LocalType::integer); }

    std::map<int, Vector> vectors_;  ///< By number.
    // Addresses of what an entry has, or the end of that.
    Local base_at_{}, bases_end_{}, offsets_at_{};
    std::map<Parameter, Local> factors_at_;
    // What belongs to the entry.
    std::vector<Local> of_entry_;
    LocalBySlot bases_of_fields_;  ///< Addresses from which offsets count.
    // What belongs to the vector in the entry.
    std::vector<Local> targets_;  ///< By lane: bytes from the base.
    LocalBySlot fields_, differences_;
    std::map<Parameter, Local> factors_;
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
    code().open(Plain::block);
    code().get(base_at_);
    code().get(bases_end_);
    code().write(Plain::greater_equal_unsigned);
    code().branch_if();
    code().open(Plain::loop);
    add_entry();
    code().get(base_at_);
    code().get(bases_end_);
    code().write(Plain::less_unsigned);
    code().branch_if();
    code().close();
    code().close();
}

/// Sets the sums to 0, and loads what their terms have of the cells themselves.
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

/// The addresses of the first entry of the slice, which is number column / 16 of the row, at lane
/// column mod 16.
void LinkedCells::find_links() {
    begin_vector(0);
    push_column();
    const Local column = keep_address();
    code().get(local_of(Parameter::column_end));
    code().integer(slice_cells - 1);
    code().write(Plain::add);
    code().integer(slice_shift);
    code().write(Plain::shift_right);
    code().get(local_of(Parameter::row_begin));
    code().write(Plain::multiply);
    code().get(column);
    code().integer(slice_shift);
    code().write(Plain::shift_right);
    code().write(Plain::add);
    const Local slice = keep_address();
    push_address(Parameter::starts, slice, 2);
    const Local start = keep_address();
    const auto entry_at = [&](std::uint32_t slices_after) {
        code().get(start);
        code().access(Plain::load, 4 * slices_after);
        return keep_address();
    };
    const Local entry = entry_at(0), last = entry_at(1);
    push_address(Parameter::bases, entry, 2);
    base_at_ = keep_address();
    push_address(Parameter::bases, last, 2);
    bases_end_ = keep_address();
    code().get(entry);
    code().integer(slice_shift);
    code().write(Plain::shift_left);
    code().get(column);
    code().integer(slice_cells - 1);
    code().write(Plain::bits_and);
    code().write(Plain::add);
    const Local link = keep_address();
    push_address(Parameter::offsets, link, 1);
    offsets_at_ = keep_address();
    for (const auto& [key, sum] : vectors_.at(0).sums) {
        const auto [known, is_new] = factors_at_.try_emplace(weights_of(key.first));
        if (!is_new) continue;
        push_address(known->first, link, function_.number_shift());
        known->second = keep_address();
    }
}

void LinkedCells::push_address(Parameter array, Local element, int shift) {
    code().get(local_of(array));
    code().get(element);
    code().integer(shift);
    code().write(Plain::shift_left);
    code().write(Plain::add);
}

void LinkedCells::advance(Local address, int bytes) {
    code().get(address);
    code().integer(bytes);
    code().write(Plain::add);
    code().set(address);
}

void LinkedCells::add_entry() {
    code().get(base_at_);
    code().access(Plain::load, 0);
    code().integer(function_.number_shift());
    code().write(Plain::shift_left);
    const Local base = keep_in_entry(LocalType::integer);
    for (const auto& [slot, own] : vectors_.at(0).own) {
        code().get(plane(Parameter::fields, slot.index()));
        code().get(base);
        code().write(Plain::add);
        bases_of_fields_[slot] = keep_in_entry(LocalType::integer);
    }
    for (const auto& [number, vector] : vectors_) {
        begin_vector(number);
        find_targets();
        for (const auto& [key, sum] : vector.sums) {
            code().get(sum);
            push_term(key);
            arithmetic().add();
            code().set(sum);
        }
        targets_.clear();
        fields_.clear();
        differences_.clear();
        factors_.clear();
    }
    for (const Local local : of_entry_) function_.give_back(local);
    advance(base_at_, 4);
    advance(offsets_at_, 2 * slice_cells);
    for (const auto& [array, address] : factors_at_) {
        advance(address, slice_cells * function_.number_bytes());
    }
}

void LinkedCells::find_targets() {
    for (int lane = 0; lane < function_.lanes(); ++lane) {
        const int link = vector_ * function_.lanes() + lane;
        code().get(offsets_at_);
        code().access(Plain::load_16_signed, static_cast<std::uint32_t>(2 * link));
        code().integer(function_.number_shift());
        code().write(Plain::shift_left);
        targets_.push_back(keep_in_entry(LocalType::integer));
    }
}

/// What the entry adds to a sum.
void LinkedCells::push_term(const SumKey& key) {
    const auto [op, payload] = key;
    const Flow flow = Flow::with(payload);
    code().get(factors(weights_of(op)));
    if (op == Op::link_flow) {
        code().get(at_targets(flow.factor));
        code().get(own(flow.factor));
        arithmetic().add();
    }
    code().get(difference(flow.of));
    if (op == Op::link_squares) code().get(difference(flow.of));
    if (op == Op::link_flow || op == Op::link_squares) arithmetic().multiply();
    arithmetic().multiply();
}

/// What a field holds in the cells to which the links lead.
Local LinkedCells::at_targets(FieldSlot slot) {
    const auto [known, is_new] = fields_.try_emplace(slot);
    if (!is_new) return known->second;
    for (int lane = 0; lane < function_.lanes(); ++lane) {
        code().get(bases_of_fields_.at(slot));
        code().get(targets_[static_cast<std::size_t>(lane)]);
        code().write(Plain::add);
        if (lane == 0) {
            code().access(Lanes::load_first, pad_bytes());
            known->second = keep_in_entry();
        } else {
            code().get(known->second);
            code().access(Lanes::load_lane, pad_bytes(), lane);
            code().set(known->second);
        }
    }
    if (is_exact_) {
        code().get(known->second);
        arithmetic().flush();
        code().set(known->second);
    }
    return known->second;
}

/// f_j − f_i.
Local LinkedCells::difference(FieldSlot slot) {
    const auto [known, is_new] = differences_.try_emplace(slot);
    if (is_new) {
        code().get(at_targets(slot));
        code().get(own(slot));
        arithmetic().subtract();
        known->second = keep_in_entry();
    }
    return known->second;
}

Local LinkedCells::factors(Parameter array) {
    const auto [known, is_new] = factors_.try_emplace(array);
    if (is_new) {
        code().get(factors_at_.at(array));
        code().access(Whole::load, static_cast<std::uint32_t>(vector_ * Code::vector_bytes));
        arithmetic().flush();
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
