// Operators as differences of what the cells around have. c is the own cell, N, S, E, W, U and D
// the ones around; h is the side of a cell. Spec/numerics.md has the same formulas.
#include "lang/lower/lower_pass.h"

#include "core/check.h"

namespace cascade::lowering {

/// Where the factor is 1 nothing is multiplied.
ValueId PassLowering::scaled(ValueId value, double factor) {
    if (factor == 1) return value;
    return builder_.multiply(value, builder_.number(factor));
}

/// The operation `laplacian` reads a plane as it is.
bool PassLowering::can_read_as_plane(PartId id) const {
    if (graph_[id].is_uniform) return false;
    return planner_.is_step_invariant(id) || graph_.is_plane(id) ||
           (planner_.is_plane_in(id, pass_) && !graph_[id].is_open());
}

/// Of a part that a pass has written, this one or that of the step-invariant parts.
std::uint32_t PassLowering::slot_of_own_plane(PartId id) {
    return planner_.is_step_invariant(id)
               ? assembly_.step_invariant_slot(storage_.step_invariants[id])
               : assembly_.temporary_slot(storage_.temporary[id]);
}

std::uint32_t PassLowering::slot_of_plane(PartId id) {
    if (planner_.is_step_invariant(id) || planner_.is_plane_in(id, pass_))
        return slot_of_own_plane(id);
    return assembly_.plane_slot(graph_, id);
}

ValueId PassLowering::stencil(PartId id) {
    const Part& part = graph_[id];
    const PartId operand = part.operands[part.operand_count - 1];
    if (graph_[operand].is_uniform) return builder_.number(0);
    if (graph_.is_linked()) return over_links(part);
    const auto [order, first, second] = derivative_of(part.node.function);
    if (order == 1) return difference(operand, first);
    if (order == 2 && first == second) return second_difference(operand, first);
    if (order == 2) return cross_difference(operand, first, second);
    switch (part.node.function) {
        case Function::lap: return laplacian(operand);
        case Function::grad2: return squared_gradient(operand);
        case Function::advect: return advection(part);
        case Function::diffuse: return anisotropic(part);
        default: break;
    }
    CHECK(false, "lowering: every operator has its differences");
}

/// Sums over the links of a cell. |∇e|² is half of the Laplacian of e² less e times that of e.
ValueId PassLowering::over_links(const Part& part) {
    const PartId operand = part.operands[part.operand_count - 1];
    const std::uint32_t slot = slot_of_plane(operand);
    if (const Derivative derivative = derivative_of(part.node.function); derivative.order == 1) {
        constexpr std::array gradients{Op::gradient_x, Op::gradient_y, Op::gradient_z};
        return builder_.over_links(gradients[static_cast<std::size_t>(derivative.first)], slot);
    }
    switch (part.node.function) {
        case Function::lap:
            if (part.operand_count == 1) return builder_.laplacian(slot);
            return scaled(builder_.link_flow({slot_of_plane(part.operands[0]), slot}), 0.5);
        case Function::grad2: return scaled(builder_.over_links(Op::link_squares, slot), 0.5);
        default: break;
    }
    CHECK(false, "lowering: operators without a meaning on a model are refused");
}

/// (((((N + S) + E) + W) + U) + D − 2n·c) / h² of n axes.
ValueId PassLowering::laplacian(PartId operand) {
    const double factor = 1 / (grid_.spacing * grid_.spacing);
    if (!graph_.has_mask() && can_read_as_plane(operand)) {
        return scaled(builder_.laplacian(slot_of_plane(operand)), factor);
    }
    std::optional<ValueId> sum;
    const auto add = [&](int axis, int by) {
        const ValueId value = beside(operand, Offset::along(axis, by));
        sum = sum ? builder_.add(*sum, value) : value;
    };
    const Axes& axes = planner_.axes();
    if (axes.has(1)) add(1, -1), add(1, 1);
    if (axes.has(0)) add(0, 1), add(0, -1);
    if (axes.has(2)) add(2, -1), add(2, 1);
    const auto neighbours = static_cast<double>(2 * axes.present.size());
    const ValueId own = builder_.multiply(builder_.number(neighbours), number_at(operand, {}));
    // As the operation on a plane rounds it, so that contraction cannot tell which of the two was
    // taken.
    builder_.keep(own);
    return scaled(builder_.subtract(*sum, own), factor);
}

/// (E − W) / 2h.
ValueId PassLowering::difference(PartId operand, int axis) {
    if (!planner_.axes().has(axis)) return builder_.number(0);
    const ValueId difference = builder_.subtract(beside(operand, Offset::along(axis, 1)),
                                                 beside(operand, Offset::along(axis, -1)));
    return scaled(difference, 1 / (2 * grid_.spacing));
}

/// ((E + W) − 2c) / h².
ValueId PassLowering::second_difference(PartId operand, int axis) {
    if (!planner_.axes().has(axis)) return builder_.number(0);
    const ValueId sum = builder_.add(beside(operand, Offset::along(axis, 1)),
                                     beside(operand, Offset::along(axis, -1)));
    const ValueId own = builder_.multiply(builder_.number(2), number_at(operand, {}));
    return scaled(builder_.subtract(sum, own), 1 / (grid_.spacing * grid_.spacing));
}

/// ((SE + NW) − (NE + SW)) / 4h².
ValueId PassLowering::cross_difference(PartId operand, int first, int second) {
    if (!planner_.axes().has(first) || !planner_.axes().has(second)) return builder_.number(0);
    const auto corner = [&](int a, int b) {
        return beside(operand, Offset::along(first, a) + Offset::along(second, b));
    };
    const ValueId rising = builder_.add(corner(1, 1), corner(-1, -1));
    const ValueId falling = builder_.add(corner(1, -1), corner(-1, 1));
    return scaled(builder_.subtract(rising, falling), 1 / (4 * grid_.spacing * grid_.spacing));
}

/// The sum of the squares of the central differences, x first.
ValueId PassLowering::squared_gradient(PartId operand) {
    std::optional<ValueId> sum;
    for (const int axis : planner_.axes().present) {
        const ValueId along = difference(operand, axis);
        const ValueId square = builder_.multiply(along, along);
        sum = sum ? builder_.add(*sum, square) : square;
    }
    return sum.value_or(builder_.number(0));
}

/// Σ v · (v > 0 ? c − W : E − c) / h: from where it flows.
ValueId PassLowering::advection(const Part& part) {
    const std::uint32_t velocities = part.operand_count - 1;
    const PartId operand = part.operands[velocities];
    std::optional<ValueId> sum;
    for (const int axis : planner_.axes().present) {
        if (static_cast<std::uint32_t>(axis) >= velocities) continue;
        const ValueId velocity = number_at(part.operands[static_cast<std::size_t>(axis)], {});
        const ValueId own = number_at(operand, {});
        const ValueId behind = builder_.subtract(own, beside(operand, Offset::along(axis, -1)));
        const ValueId ahead = builder_.subtract(beside(operand, Offset::along(axis, 1)), own);
        const ValueId flows_forwards = builder_.apply(Op::less, builder_.number(0), velocity);
        const ValueId term =
            builder_.multiply(velocity, builder_.select(flows_forwards, behind, ahead));
        sum = sum ? builder_.add(*sum, term) : term;
    }
    return scaled(sum.value_or(builder_.number(0)), 1 / grid_.spacing);
}

/// a11 ∂²c/∂x² + a22 ∂²c/∂y² + 2 a12 ∂²c/∂x∂y with y down (Witkin & Kass, eq 7).
ValueId PassLowering::anisotropic(const Part& part) {
    const Value& tensor = at(part.operands[0], {});
    const PartId operand = part.operands[1];
    const ValueId along_x = builder_.multiply(tensor[0], second_difference(operand, 0));
    const ValueId along_y = builder_.multiply(tensor[2], second_difference(operand, 1));
    const ValueId across = builder_.multiply(tensor[1], cross_difference(operand, 0, 1));
    return builder_.add(builder_.add(along_x, along_y), scaled(across, 2));
}

}  // namespace cascade::lowering
