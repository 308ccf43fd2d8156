// The Laplacian of cells on a grid.
#include "wasm/cells.h"

#include "core/check.h"

#include <limits>

namespace cascade::wasm {
namespace {

class GridCells final : public Cells {
public:
    using Cells::Cells;

    Local laplacian(FieldSlot slot) override;
    Local link_sum(const Instruction&) override {
        CHECK(false, "cells of a grid have no links");
        return {};
    }

private:
    void without_multiple(Local sum, Local own, double times);
};

// The order of the sums is the specification's: ((((N + S) + E) + W) + U) + D.
Local GridCells::laplacian(FieldSlot slot) {
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
    const Local sum = keep();
    const Local own = operand({slot});
    if (stencil_.axes() < 3) {
        without_multiple(sum, own, 2.0 * stencil_.axes());
    } else {
        code().get(sum);
        code().get(own);
        code().get(function_.number(6));
        code().write(Lanes::multiply);
        arithmetic().subtract();
    }
    return keep();
}

// sum − times · own with one rounding. Two and four times a number are exact unless they overflow;
// then the number is subtracted from a part of the sum.
void GridCells::without_multiple(Local sum, Local own, double times) {
    const double largest = function_.precision() == Precision::single
                               ? double{std::numeric_limits<float>::max()}
                               : std::numeric_limits<double>::max();
    code().get(sum);
    code().get(function_.number(1 / times));
    code().write(Lanes::multiply);
    code().get(own);
    code().write(Lanes::subtract);
    code().get(function_.number(times));
    code().write(Lanes::multiply);
    code().get(sum);
    code().get(own);
    code().get(function_.number(times));
    code().write(Lanes::multiply);
    arithmetic().subtract();
    code().get(own);
    code().write(Lanes::absolute);
    code().get(function_.number(largest / 4));
    code().write(Lanes::greater);
    code().write(Whole::choose);
}

}  // namespace

std::unique_ptr<Cells> make_grid_cells(Function& function, const CellKernel& kernel,
                                       Stencil stencil, Place place, bool is_exact) {
    return std::make_unique<GridCells>(function, kernel, stencil, place, is_exact);
}

}  // namespace cascade::wasm
