// Vectors at faces, and their divergence.
//
// A face lies between a cell and the next one along an axis. What the flux through it is made of is
// averaged over the two cells, (c + E) / 2, and differences are taken across it, so both cells see
// the same number and what leaves one arrives in the other: sums are conserved to rounding.
#include "lang/lower/lower_pass.h"

#include "core/check.h"

namespace cascade::lowering {

ValueId PassLowering::average(PartId id, Face face) {
    if (graph_[id].is_uniform) return number_at(id, {});
    return scaled(builder_.add(beside(id, face.cell()), beside(id, face.next())), 0.5);
}

ValueId PassLowering::tensor_entry(PartId tensor, std::size_t entry, Face face) {
    if (graph_[tensor].is_uniform) return at(tensor, {})[entry];
    return scaled(builder_.add(entry_beside(tensor, entry, face.cell()),
                               entry_beside(tensor, entry, face.next())),
                  0.5);
}

/// Across the face (E − c) / h; along it the mean of the central differences of both cells,
/// ((S − N) + (SE − NE)) / 4h.
ValueId PassLowering::gradient(PartId operand, Face face) {
    if (graph_[operand].is_uniform || !planner_.axes().has(face.component)) {
        return builder_.number(0);
    }
    if (face.component == face.axis) {
        const ValueId across =
            builder_.subtract(beside(operand, face.next()), beside(operand, face.cell()));
        return scaled(across, 1 / grid_.spacing);
    }
    const auto along = [&](Offset cell) {
        return builder_.subtract(beside(operand, cell, Offset::along(face.component, 1)),
                                 beside(operand, cell, Offset::along(face.component, -1)));
    };
    return scaled(builder_.add(along(face.cell()), along(face.next())), 1 / (4 * grid_.spacing));
}

ValueId PassLowering::vector_at(PartId id, Face where) {
    const Part& part = graph_[id];
    const PartId a = part.operands[0];
    const PartId b = part.operands[part.operand_count - 1];
    const auto is_vector = [&](PartId operand) {
        return graph_[operand].node.type == ValueType::vector;
    };
    switch (part.node.function) {
        case Function::grad: return gradient(a, where);
        case Function::vector:
            if (static_cast<std::uint32_t>(where.component) >= part.operand_count) {
                return builder_.number(0);
            }
            return average(part.operands[static_cast<std::size_t>(where.component)], where);
        case Function::negate: return builder_.apply(Op::negate, face(a, where));
        case Function::add: return builder_.add(face(a, where), face(b, where));
        case Function::subtract: return builder_.subtract(face(a, where), face(b, where));
        case Function::divide: return builder_.divide(face(a, where), average(b, where));
        case Function::multiply: break;
        default: CHECK(false, "lowering: every vector has its faces");
    }
    if (graph_[a].node.type == ValueType::tensor) {
        std::optional<ValueId> sum;
        for (int column = 0; column < 2; ++column) {
            const int entry = entry_of_tensor(where.component, column);
            if (entry < 0) return builder_.number(0);
            const ValueId term =
                builder_.multiply(tensor_entry(a, static_cast<std::size_t>(entry), where),
                                  face(b, {where.axis, column, where.side}));
            sum = sum ? builder_.add(*sum, term) : term;
        }
        return *sum;
    }
    if (is_vector(a)) return builder_.multiply(face(a, where), average(b, where));
    return builder_.multiply(average(a, where), face(b, where));
}

/// Nothing flows out of the mask, nor through a side where all species of a flux are mirrored.
/// Differences across it are 0 by themselves; other vectors, and what a tensor turns out of the
/// side's direction, are cut off there.
void PassLowering::find_what_crosses_sides() {
    const Stage& stage = graph_.program().stages[graph_.stage()];
    const System& system = graph_.program().system_of(graph_.stage());
    const SideRules boundary(grid_.boundary);
    std::vector<std::array<SideKind, side_count>> of_item(system.item_count());
    std::size_t species = 0;
    for (std::uint32_t item = 0; item < system.item_count(); ++item) {
        for (std::size_t side = 0; side < side_count; ++side) {
            of_item[item][side] = system.is_species(item) && !stage.sides.empty()
                                      ? stage.sides[species][side].kind
                                      : boundary.at[side].kind;
        }
        if (system.is_species(item)) ++species;
    }
    crossings_.assign(graph_.size(), {});
    for (PartId id = 0; id < graph_.size(); ++id) {
        const Part& part = graph_[id];
        Crossing& crossing = crossings_[id];
        const bool is_vector = part.node.type == ValueType::vector;
        crossing.goes_across = is_vector && part.calls(Function::vector);
        if (part.node.kind == NodeKind::own && system.is_species(part.node.index)) {
            crossing.has_species = true;
            for (std::size_t side = 0; side < side_count; ++side) {
                crossing.is_open[side] = of_item[part.node.index][side] != SideKind::no_flux;
            }
        }
        for (std::uint32_t k = 0; k < part.operand_count; ++k) {
            const Crossing& operand = crossings_[part.operands[k]];
            const bool turns = graph_[part.operands[k]].node.type == ValueType::tensor;
            crossing.goes_across |= is_vector && (operand.goes_across || turns);
            crossing.has_species |= operand.has_species;
            for (std::size_t side = 0; side < side_count; ++side) {
                crossing.is_open[side] |= operand.is_open[side];
            }
        }
    }
}

ValueId PassLowering::through_sides(PartId flux, Face face, ValueId value) {
    if (crossings_.empty()) find_what_crosses_sides();
    const Crossing& crossing = crossings_[flux];
    if (!crossing.goes_across) return value;
    if (graph_.has_mask()) {
        const Offset other = face.side == 0 ? face.next() : face.cell();
        value = chosen(other, value, builder_.number(0));
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

/// Σ (flux after − flux before) / h, x first.
ValueId PassLowering::divergence(const Part& part) {
    const PartId flux = part.operands[0];
    std::optional<ValueId> sum;
    for (const int axis : planner_.axes().present) {
        std::array<ValueId, 2> through{};
        for (const int side : {0, 1}) {
            const Face at{axis, axis, side};
            ValueId& value = through[static_cast<std::size_t>(side)];
            value = through_sides(flux, at, face(flux, at));
        }
        const ValueId term = builder_.subtract(through[0], through[1]);
        sum = sum ? builder_.add(*sum, term) : term;
    }
    return scaled(sum.value_or(builder_.number(0)), 1 / grid_.spacing);
}

}  // namespace cascade::lowering
