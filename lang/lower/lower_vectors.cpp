// Computes vectors at faces, and their divergence.
//
// A face is between a cell and the next cell along an axis. Factors of the flux through the face
// are averaged over both cells, (c + E) / 2, and differences are taken across the face. So both
// cells compute the same flux, and sums over all cells are conserved up to rounding.
#include "lang/lower/lower_pass.h"

#include "lang/program/vector_functions.h"

#include <array>
#include <optional>
#include <span>

namespace cascade::lowering {

Fluxes::Fluxes(const PassView& pass, KernelAssembly& assembly, const NodeValues& values)
    : graph_(pass.graph),
      axes_(pass.planner.axes()),
      builder_(assembly.builder()),
      values_(values),
      grid_(graph_.program().domain.grid) {}

ValueId Fluxes::difference(NodeId id, Difference kind, Face face) const {
    const Taps taps = taps_of(kind, axes_, face.axis);
    const ValueId sum = *values_.weighted(id, taps, false, face.cell());
    return values_.scaled(sum, 1 / taps.size(grid_.spacing));
}

ValueId Fluxes::average(NodeId id, Face face) const {
    if (graph_.is_uniform(id)) return values_.number_at(id, {});
    return difference(id, Difference::average, face);
}

/// A component of a gradient at a face. The component across the face is (E − c) / h. A component
/// along the face is the mean of the central differences of both cells, ((S − N) + (SE − NE)) / 4h.
ValueId Fluxes::gradient(NodeId operand, Face face) const {
    if (graph_.is_uniform(operand) || !axes_.has(face.component)) {
        return builder_.number(0);
    }
    if (face.component == face.axis) return difference(operand, Difference::across, face);
    const auto along = [&](Offset cell) {
        return builder_.subtract(values_.beside(operand, cell, Offset::along(face.component, 1)),
                                 values_.beside(operand, cell, Offset::along(face.component, -1)));
    };
    return values_.scaled(builder_.add(along(face.cell()), along(face.next())),
                          1 / (4 * grid_.spacing));
}

/// Computes a component of a vector at a face from the components of its operands.
struct Fluxes::AtFace {
    const Fluxes& own;
    Face where;

    KernelBuilder& builder() const { return own.builder_; }
    ValueId flow(NodeId vector) const { return own.values_.face(vector, where); }
    ValueId average(NodeId number) const { return own.average(number, where); }

    ValueId gradient(NodeId of) const { return own.gradient(of, where); }
    ValueId components(std::span<const NodeId> parts) const {
        const auto component = static_cast<std::size_t>(where.component);
        return component < parts.size() ? average(parts[component]) : builder().number(0);
    }
    ValueId negative(NodeId vector) const { return builder().apply(Op::negate, flow(vector)); }
    ValueId sum(NodeId a, NodeId b) const { return builder().add(flow(a), flow(b)); }
    ValueId difference(NodeId a, NodeId b) const { return builder().subtract(flow(a), flow(b)); }
    ValueId quotient(NodeId vector, NodeId by) const {
        return builder().divide(flow(vector), average(by));
    }
    ValueId product(NodeId a, NodeId b, bool is_vector_first) const {
        return is_vector_first ? builder().multiply(flow(a), average(b))
                               : builder().multiply(average(a), flow(b));
    }
    ValueId turned(NodeId tensor, NodeId vector) const {
        const int size = tensor_size(own.graph_[tensor]);
        if (where.component >= size) return builder().number(0);
        std::optional<ValueId> sum;
        for (int column = 0; column < size; ++column) {
            const std::size_t entry = tensor_entry(size, where.component, column);
            const ValueId term =
                builder().multiply(average(own.graph_[tensor].operands[entry]),
                                   own.values_.face(vector, {where.axis, column, where.side}));
            sum = sum ? builder().add(*sum, term) : term;
        }
        return *sum;
    }
};

ValueId Fluxes::at_face(NodeId id, Face where) const {
    return vector_by(AtFace{*this, where}, graph_, graph_[id]);
}

ValueId Fluxes::through_sides(NodeId flux, Face face, ValueId value) {
    if (crossings_.empty()) crossings_ = crossings_of(graph_);
    const Crossing& crossing = crossings_[flux];
    if (!crossing.goes_across) return value;
    if (graph_.has_mask() && !crossing.is_open[static_cast<std::size_t>(Side::border)]) {
        const Offset other = face.side == 0 ? face.next() : face.cell();
        value = values_.chosen(other, value, builder_.number(0));
    }
    const std::size_t side = 2 * static_cast<std::size_t>(face.axis) + (face.side == 0 ? 1 : 0);
    const bool is_open = crossing.has_species
                             ? crossing.is_open[side]
                             : SideRules(grid_.boundary).at[side].kind == SideKind::periodic;
    if (is_open) return value;
    const std::int64_t count = face.axis == 0   ? grid_.width
                               : face.axis == 1 ? grid_.height
                                                : grid_.depth;
    const ValueId cell = face.axis == 0   ? builder_.cell_column()
                         : face.axis == 1 ? builder_.cell_row()
                                          : builder_.cell_slice();
    const auto last = static_cast<double>(face.side == 0 ? count - 1 : 0);
    const ValueId is_side =
        builder_.apply(Op::equal, builder_.apply(Op::bits_to_number, cell), builder_.number(last));
    return builder_.select(is_side, builder_.number(0), value);
}

/// Σ (flux after − flux before) / h over all axes, x first.
ValueId Fluxes::divergence(const Node& node) {
    const NodeId flux = node.operands[0];
    std::optional<ValueId> sum;
    for (const int axis : axes_.present) {
        std::array<ValueId, 2> through{};
        for (const int side : {0, 1}) {
            const Face at{axis, axis, side};
            ValueId& value = through[static_cast<std::size_t>(side)];
            value = through_sides(flux, at, values_.face(flux, at));
        }
        const ValueId term = builder_.subtract(through[0], through[1]);
        sum = sum ? builder_.add(*sum, term) : term;
    }
    return values_.scaled(sum.value_or(builder_.number(0)), 1 / grid_.spacing);
}

}  // namespace cascade::lowering
