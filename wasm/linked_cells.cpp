// Sums over the links of cells (core/links.h): one loop over the entries of the vector's slice
// computes all sums of the kernel together.
#include "wasm/cells.h"

#include "core/links.h"

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

    Local laplacian(FieldSlot slot) override { return sums_.at({Op::laplacian, slot.index()}); }
    Local link_sum(const Instruction& sum) override { return sums_.at(key_of(sum)); }

private:
    using LocalBySlot = std::map<FieldSlot, Local>;

    void begin_cells() override;
    void find_links();
    void push_first_link(Local slice, std::uint32_t slices_after);
    void add_entry();
    void push_term(const SumKey& key);
    void find_targets();
    Local at_targets(FieldSlot slot);
    Local difference(FieldSlot slot);
    Local factors(Parameter array);

    /// What is on top of the stack, until the end of the entry.
    Local keep_in_entry(LocalType type = LocalType::vector) {
        of_entry_.push_back(function_.keep(LoopLevel::cell, type));
        return of_entry_.back();
    }
    void push_element(Parameter array, Local element, int shift) {
        code().get(local_of(array));
        code().get(element);
        code().integer(shift);
        code().write(Plain::shift_left);
        code().write(Plain::add);
    }

    std::map<SumKey, Local> sums_;
    Local link_{};  ///< The number of the vector's first link in the entry.
    Local end_{};   ///< That of the first link after the slice.
    // What belongs to the entry.
    std::vector<Local> of_entry_;
    std::vector<Local> targets_;  ///< By lane: bytes from cell (0, 0).
    LocalBySlot fields_, differences_;
    std::map<Parameter, Local> factors_;
};

void LinkedCells::begin_cells() {
    sums_.clear();
    for (const Instruction& instruction : kernel_.code) {
        if (!is_link_sum(instruction.op)) continue;
        const auto [sum, is_new] = sums_.try_emplace(key_of(instruction));
        if (!is_new) continue;
        code().get(function_.constant(0));
        sum->second = keep();
        // Loads before the loop what it reads of the cells themselves.
        const Flow flow = Flow::with(instruction.payload);
        operand({flow.of});
        if (instruction.op == Op::link_flow) operand({flow.factor});
    }
    if (sums_.empty()) return;
    find_links();
    code().open(Plain::block);
    code().get(link_);
    code().get(end_);
    code().write(Plain::greater_equal_unsigned);
    code().branch_if();
    code().open(Plain::loop);
    add_entry();
    code().get(link_);
    code().integer(slice_cells);
    code().write(Plain::add);
    code().tee(link_);
    code().get(end_);
    code().write(Plain::less_unsigned);
    code().branch_if();
    code().close();
    code().close();
    function_.give_back(link_);
    function_.give_back(end_);
}

/// The links of the vector: slice column / 16 of the row, lane column mod 16.
void LinkedCells::find_links() {
    push_column();
    const Local column = function_.keep(LoopLevel::cell, LocalType::integer);
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
    const Local slice = function_.keep(LoopLevel::cell, LocalType::integer);
    push_first_link(slice, 0);
    code().get(column);
    code().integer(slice_cells - 1);
    code().write(Plain::bits_and);
    code().write(Plain::add);
    link_ = function_.keep(LoopLevel::cell, LocalType::integer);
    push_first_link(slice, 1);
    end_ = function_.keep(LoopLevel::cell, LocalType::integer);
    function_.give_back(column);
    function_.give_back(slice);
}

void LinkedCells::push_first_link(Local slice, std::uint32_t slices_after) {
    push_element(Parameter::starts, slice, 2);
    code().access(Plain::load, 4 * slices_after);
    code().integer(slice_shift);
    code().write(Plain::shift_left);
}

void LinkedCells::add_entry() {
    find_targets();
    for (const auto& [key, sum] : sums_) {
        code().get(sum);
        push_term(key);
        arithmetic().add();
        code().set(sum);
    }
    for (const Local local : of_entry_) function_.give_back(local);
    of_entry_.clear();
    targets_.clear();
    fields_.clear();
    differences_.clear();
    factors_.clear();
}

/// What the entry adds to a sum.
void LinkedCells::push_term(const SumKey& key) {
    const auto [op, payload] = key;
    const Flow flow = Flow::with(payload);
    code().get(factors(weights_of(op)));
    if (op == Op::link_flow) {
        code().get(at_targets(flow.factor));
        code().get(operand({flow.factor}));
        arithmetic().add();
    }
    code().get(difference(flow.of));
    if (op == Op::link_squares) code().get(difference(flow.of));
    if (op == Op::link_flow || op == Op::link_squares) arithmetic().multiply();
    arithmetic().multiply();
}

void LinkedCells::find_targets() {
    code().get(local_of(Parameter::bases));
    code().get(link_);
    code().integer(slice_shift);
    code().write(Plain::shift_right);
    code().integer(2);
    code().write(Plain::shift_left);
    code().write(Plain::add);
    code().access(Plain::load, 0);
    const Local base = keep_in_entry(LocalType::integer);
    push_element(Parameter::offsets, link_, 1);
    const Local offsets = keep_in_entry(LocalType::integer);
    for (int lane = 0; lane < function_.lanes(); ++lane) {
        code().get(offsets);
        code().access(Plain::load_16_signed, static_cast<std::uint32_t>(2 * lane));
        code().get(base);
        code().write(Plain::add);
        code().integer(function_.number_shift());
        code().write(Plain::shift_left);
        targets_.push_back(keep_in_entry(LocalType::integer));
    }
}

/// What a field holds in the cells to which the links lead.
Local LinkedCells::at_targets(FieldSlot slot) {
    const auto [known, is_new] = fields_.try_emplace(slot);
    if (!is_new) return known->second;
    const auto push_address = [&](int lane) {
        code().get(plane(Parameter::fields, slot.index()));
        code().get(targets_[static_cast<std::size_t>(lane)]);
        code().write(Plain::add);
    };
    push_address(0);
    code().access(Lanes::load_first, pad_bytes());
    const Local numbers = keep_in_entry();
    for (int lane = 1; lane < function_.lanes(); ++lane) {
        push_address(lane);
        code().get(numbers);
        code().access(Lanes::load_lane, pad_bytes(), lane);
        code().set(numbers);
    }
    if (is_exact_) {
        code().get(numbers);
        arithmetic().flush();
        code().set(numbers);
    }
    return known->second = numbers;
}

/// f_j − f_i.
Local LinkedCells::difference(FieldSlot slot) {
    const auto [known, is_new] = differences_.try_emplace(slot);
    if (is_new) {
        code().get(at_targets(slot));
        code().get(operand({slot}));
        arithmetic().subtract();
        known->second = keep_in_entry();
    }
    return known->second;
}

Local LinkedCells::factors(Parameter array) {
    const auto [known, is_new] = factors_.try_emplace(array);
    if (is_new) {
        push_element(array, link_, function_.number_shift());
        code().access(Whole::load, 0);
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
