// What parts are beyond the sides of the grid (spec/domain.md, "Beyond the sides").
//
// A species is there what its sides say, a function what it makes of its operands there. So
// lap(f(u)) + lap(g) is lap(f(u) + g), also at the sides. What is mirrored: the values of
// operators, what is drawn or drawn as a shape, parameters, files.
#include "lang/lower/part_graph.h"

namespace cascade::lowering {

namespace {

using Axes3 = std::array<Beyond, 3>;

Beyond beyond_of(Boundary boundary) {
    return boundary == Boundary::periodic ? Beyond::periodic : Beyond::mirrored;
}

Axes3 beyond_of(const Boundaries& boundary) {
    return {beyond_of(boundary.x), beyond_of(boundary.y), beyond_of(boundary.z)};
}

/// Both sides of an axis are periodic or neither is.
Beyond beyond_of(SideKind first, SideKind second) {
    if (takes_value(first) || takes_value(second)) return Beyond::itself;
    return first == SideKind::periodic ? Beyond::periodic : Beyond::mirrored;
}

/// Of an item of a stage that varies.
Axes3 beyond_of_item(const Program& program, std::uint32_t stage, std::uint32_t item) {
    const System& system = program.system_of(stage);
    const auto& sides = program.stages[stage].sides;
    if (sides.empty() || !system.is_species(item)) return beyond_of(program.domain.grid.boundary);
    std::size_t species = 0;
    for (std::uint32_t before = 0; before < item; ++before)
        species += system.is_species(before) ? 1 : 0;
    Axes3 beyond{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        beyond[axis] = beyond_of(sides[species][2 * axis].kind, sides[species][2 * axis + 1].kind);
    }
    return beyond;
}

/// Of a function of two parts.
Beyond together(Beyond a, Beyond b) {
    if (a == Beyond::anything || a == b) return b;
    return b == Beyond::anything ? a : Beyond::itself;
}

}  // namespace

std::array<Beyond, 3> PartGraph::beyond(const Part& part) const {
    const Grid& grid = program_.domain.grid;
    Axes3 beyond{};
    if (part.is_uniform) return beyond;
    if (part.node.kind == NodeKind::own) {
        beyond = beyond_of_item(program_, stage_, part.node.index);
    } else if (part.node.kind == NodeKind::earlier) {
        beyond = beyond_of_item(program_, part.node.stage, part.node.index);
    } else if (part.node.kind != NodeKind::call) {
        beyond = beyond_of(grid.boundary);
    } else {
        for (std::uint32_t k = 0; k < part.operand_count; ++k) {
            const Axes3& operand = parts_[part.operands[k]].beyond;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                beyond[axis] = together(beyond[axis], operand[axis]);
            }
        }
        if (varies_by_cell(part.node.function)) {
            // Operators, shapes, draws, files: periodic where everything in them is.
            const Axes3 usual = beyond_of(grid.boundary);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (beyond[axis] == Beyond::anything) beyond[axis] = usual[axis];
                if (beyond[axis] == Beyond::itself) beyond[axis] = Beyond::mirrored;
            }
        }
    }
    const Stencil stencil = grid.stencil();
    if (!stencil.x) beyond[0] = Beyond::anything;
    if (!stencil.y) beyond[1] = Beyond::anything;
    if (!stencil.z) beyond[2] = Beyond::anything;
    return beyond;
}

Boundaries PartGraph::boundary(PartId id) const {
    const auto along = [&](std::size_t axis, Boundary usual) {
        switch (parts_[id].beyond[axis]) {
            case Beyond::periodic: return Boundary::periodic;
            case Beyond::mirrored: return Boundary::no_flux;
            default: return usual;
        }
    };
    const Boundaries& usual = program_.domain.grid.boundary;
    return {along(0, usual.x), along(1, usual.y), along(2, usual.z)};
}

}  // namespace cascade::lowering
