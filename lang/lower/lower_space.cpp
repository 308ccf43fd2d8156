// Functions of the place of a cell, and random ones: shapes, lattices of seeds, noise, draws.
#include "core/check.h"
#include "lang/lower/lower_formula.h"

#include <cmath>

namespace cascade::lowering {

namespace {

/// The operands from `first` on, `count` of them.
std::vector<ValueId> values_of(std::span<const Value> values, std::size_t first,
                               std::size_t count) {
    std::vector<ValueId> chosen;
    for (std::size_t k = first; k < first + count; ++k) {
        chosen.push_back(values[k][0]);
    }
    return chosen;
}

}  // namespace

Space KernelAssembly::space() {
    const Grid& grid = program_.domain.grid;
    if (program_.domain.model) {
        const auto along = [&](ModelPlane plane) {
            return SpaceAxis{of_model(plane), 1, false, true};
        };
        return {along(ModelPlane::x), along(ModelPlane::y), along(ModelPlane::z)};
    }
    const std::int64_t longest = grid.longest_side();
    const auto axis = [&](std::int64_t side, ValueId cell, Boundary boundary) {
        const double length = static_cast<double>(side) / static_cast<double>(longest);
        return SpaceAxis{coordinate(cell, longest), length, boundary == Boundary::periodic,
                         side > 1};
    };
    return {axis(grid.width, column(), grid.boundary.x), axis(grid.height, row(), grid.boundary.y),
            axis(grid.depth, slice(), grid.boundary.z)};
}

/// The draw of a cell, a word of 32 bits. Its hash knows columns and rows; slices other than the
/// first change the draw.
ValueId KernelAssembly::draw_of_cell(ValueId draw) {
    if (program_.domain.model) {
        builder_.set_cell(of_model(ModelPlane::number));
        return draw;
    }
    if (program_.domain.grid.depth == 1) return draw;
    const ValueId slice =
        builder_.apply(Op::bits_multiply, builder_.cell_slice(), builder_.word(0x9e3779b9));
    return builder_.apply(Op::bits_xor, draw, slice);
}

/// The last operands of a shape are sizes, those before them its position.
ValueId KernelAssembly::shape(const Node& node, const Cursor& cursor) {
    const std::size_t count = operand_count(node);
    const auto number = [&](std::size_t k) { return cursor.number(node, k); };
    const auto first = [&](std::size_t n) { return values_of(cursor.values, 0, n); };
    switch (node.function) {
        case Function::disc: return disc(builder_, space(), first(count - 1), number(count - 1));
        case Function::gauss: return gauss(builder_, space(), first(count - 1), number(count - 1));
        case Function::ring:
            return ring(builder_, space(), first(count - 2), number(count - 2), number(count - 1));
        case Function::box: {
            const std::vector<ValueId> size = values_of(cursor.values, count / 2, count / 2);
            return box(builder_, space(), first(count / 2), size);
        }
        case Function::stripe:
            if (count == 2) return stripe(builder_, space(), number(0), number(1));
            return turned_stripe(builder_, space(), number(0), number(1), number(2));
        default: break;
    }
    CHECK(false, "lowering: every shape has a meaning");
}

/// Every occurrence of a random function in a formula has numbers of its own.
ValueId KernelAssembly::random(const Node& node, const Cursor& cursor) {
    const auto step_word = [&] {
        return builder_.draw_word(uniform("draw", {SlotSource::Kind::draw, stage_, 0}));
    };
    const Draw draw{cursor.noise.every_step ? step_word() : builder_.word(0),
                    random_key(program_.domain.seed,
                               cursor.noise.owner.empty() ? stage().name : cursor.noise.owner,
                               cursor.noise.origin, cursor.occurrences)};
    const auto number = [&](std::size_t k) { return cursor.number(node, k); };
    switch (node.function) {
        case Function::random: {
            const ValueId uniform = builder_.random_symmetric(draw_of_cell(draw.word), draw.key);
            return builder_.add(number(0), builder_.multiply(number(1), uniform));
        }
        case Function::normal: {
            const ValueId normal = builder_.random_normal(draw_of_cell(draw.word), draw.key);
            return builder_.add(number(0), builder_.multiply(number(1), normal));
        }
        case Function::white: return white(number(0), draw);
        case Function::noise:
            return smooth_noise(builder_, space(), number(0), static_cast<int>(node.number), draw);
        case Function::lattice:
        case Function::diamond: {
            const LatticeKind kind =
                node.function == Function::diamond ? LatticeKind::diamond : LatticeKind::square;
            const ValueId jitter = operand_count(node) == 3 ? number(2) : builder_.number(0);
            return seed_lattice(builder_, space(), kind, number(0), number(1), jitter, draw);
        }
        default: break;
    }
    CHECK(false, "lowering: every random function has a meaning");
}

/// Its length, area or volume in units.
ValueId KernelAssembly::cell_content() {
    if (program_.domain.model) return of_model(ModelPlane::area);
    const Grid& grid = program_.domain.grid;
    const int axes = int{grid.width > 1} + int{grid.height > 1} + int{grid.depth > 1};
    return builder_.number(std::pow(grid.spacing, axes));
}

/// White noise in space and time: of a step of length dt in cells of content h^d it has the
/// variance strength² / (dt h^d), so that what it adds over a time and an area does not depend on
/// either.
ValueId KernelAssembly::white(ValueId strength, const Draw& draw) {
    const ValueId normal = builder_.random_normal(draw_of_cell(draw.word), draw.key);
    const ValueId share = builder_.multiply(time_step(), cell_content());
    const ValueId spread = builder_.apply(Op::square_root, share);
    return builder_.divide(builder_.multiply(strength, normal), spread);
}

}  // namespace cascade::lowering
