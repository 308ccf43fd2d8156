// The Laplacian of cells on a grid.
#include "wasm/cells.h"

#include "core/check.h"

#include <limits>

namespace cascade::wasm {
namespace {

class GridCells final : public Cells {
public:
    using Cells::Cells;

    void begin_group(int vectors) override;
    Local laplacian(FieldSlot slot) override { return laplacians_.at(vector_).at(slot); }
    Local link_sum(const Instruction&) override {
        CHECK(false, "cells of a grid have no links");
        return {};
    }

private:
    void for_each_laplacian(const auto& write);
    void push_sum(FieldSlot slot);
    void push_difference(FieldSlot slot);
    void push_difference_of_parts(FieldSlot slot);
    void compute_again_unless_finite();
    double multiple() const { return 2.0 * stencil_.axes(); }

    /// By the index of the vector in the group.
    std::map<int, std::map<FieldSlot, Local>> laplacians_;
};

/// Calls `write` for every vector of the group and every field whose Laplacian is used.
void GridCells::for_each_laplacian(const auto& write) {
    for (auto& [vector, by_slot] : laplacians_) {
        begin_vector(vector);
        for (auto& [slot, laplacian] : by_slot) write(slot, laplacian);
        end_vector();
    }
}

void GridCells::begin_group(int vectors) {
    for (const Instruction& instruction : kernel_.code) {
        if (instruction.op != Op::laplacian) continue;
        for (int vector = 0; vector < vectors; ++vector) laplacians_[vector][instruction.field()];
    }
    for_each_laplacian([&](FieldSlot slot, Local& laplacian) {
        push_difference(slot);
        laplacian = function_.keep(LoopLevel::cell);
    });
    if (!laplacians_.empty() && stencil_.axes() < 3) compute_again_unless_finite();
}

// Adds in the order of the specification: ((((N + S) + E) + W) + U) + D.
void GridCells::push_sum(FieldSlot slot) {
    bool is_first = true;
    const auto add_pair = [&](const Reading& first, const Reading& second) {
        code().get(operand(first));
        if (!is_first) arithmetic().add();
        is_first = false;
        code().get(operand(second));
        arithmetic().add();
    };
    if (stencil_.y) add_pair({slot, 0, -1}, {slot, 0, 1});
    if (stencil_.x) add_pair({slot, 1}, {slot, -1});
    if (stencil_.z) add_pair({slot, 0, 0, -1}, {slot, 0, 0, 1});
}

void GridCells::push_difference(FieldSlot slot) {
    push_sum(slot);
    code().get(operand({slot}));
    code().get(function_.number(multiple()));
    code().write(Lanes::multiply);
    arithmetic().subtract();
}

void GridCells::push_difference_of_parts(FieldSlot slot) {
    push_sum(slot);
    code().get(function_.number(1 / multiple()));
    code().write(Lanes::multiply);
    code().get(operand({slot}));
    code().write(Lanes::subtract);
    code().get(function_.number(multiple()));
    code().write(Lanes::multiply);
}

// A sum minus two or four times a value must be rounded once. The multiple is exact unless it
// overflows, and then the difference is not finite. So each group tests once whether all its
// differences are finite. If they are not, the differences with large values are computed again
// from parts that do not overflow. Testing in every cell would take a quarter longer with two
// species.
void GridCells::compute_again_unless_finite() {
    bool is_first = true;
    for_each_laplacian([&](FieldSlot, Local laplacian) {
        code().get(laplacian);
        if (!is_first) code().write(Lanes::add);
        is_first = false;
    });
    const Local total = function_.keep(LoopLevel::cell);
    code().open(Plain::block);
    code().get(total);
    code().get(total);
    code().write(Lanes::subtract);
    code().tee(total);
    code().get(total);
    code().write(Lanes::not_equal);
    code().write(Whole::any);
    code().write(Plain::equal_zero);
    function_.give_back(total);
    code().branch_if();
    const double largest = function_.precision() == Precision::single
                               ? double{std::numeric_limits<float>::max()}
                               : std::numeric_limits<double>::max();
    for_each_laplacian([&](FieldSlot slot, Local laplacian) {
        push_difference_of_parts(slot);
        code().get(laplacian);
        code().get(operand({slot}));
        code().write(Lanes::absolute);
        code().get(function_.number(largest / 4));
        code().write(Lanes::greater);
        code().write(Whole::choose);
        code().set(laplacian);
    });
    code().close();
}

}  // namespace

std::unique_ptr<Cells> make_grid_cells(Function& function, const CellKernel& kernel,
                                       Stencil stencil, Place place, bool is_exact) {
    return std::make_unique<GridCells>(function, kernel, stencil, place, is_exact);
}

}  // namespace cascade::wasm
