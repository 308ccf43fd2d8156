// Computes positions from the numbers of columns, rows and slices. The positions of a model's cells
// are read from planes.
#include "lang/lower/cell_place.h"

#include "core/check.h"
#include "lang/program/scaled_lengths.h"

#include <cmath>

namespace cascade::lowering {

/// The number of the column, row or slice. A cell beyond a periodic side has the number of the
/// opposite cell. A cell beyond a side that is not periodic has the number of the cell beside this
/// side.
ValueId CellPlace::number(int axis) {
    const Grid& grid = assembly_.program().domain.grid;
    const std::array sides{grid.width, grid.height, grid.depth};
    const std::array boundaries{grid.boundary.x, grid.boundary.y, grid.boundary.z};
    const auto k = static_cast<std::size_t>(axis);
    const ValueId cell = axis == 0   ? builder_.cell_column()
                         : axis == 1 ? builder_.cell_row()
                                     : builder_.cell_slice();
    const int by = axis == 0 ? at_.dx : axis == 1 ? at_.dy : at_.dz;
    if (by == 0) return cell;
    const std::int64_t first = 0, last = sides[k] - 1;
    const std::int64_t at_side = by > 0 ? last : first;
    const std::int64_t opposite = by > 0 ? first : last;
    const ValueId moved =
        builder_.apply(by > 0 ? Op::bits_add : Op::bits_subtract, cell, builder_.word(1));
    const ValueId is_at_side = builder_.apply(Op::equal, builder_.apply(Op::bits_to_number, cell),
                                              builder_.number(static_cast<double>(at_side)));
    const std::int64_t beyond = boundaries[k] == Boundary::periodic ? opposite : at_side;
    return builder_.select(is_at_side, builder_.word(static_cast<std::uint32_t>(beyond)), moved);
}

/// The coordinate of the cell's centre: (i + 1/2) / side.
ValueId CellPlace::coordinate(int axis, std::int64_t side) {
    const ValueId number = builder_.apply(Op::bits_to_number, this->number(axis));
    const ValueId centre = builder_.add(number, builder_.number(0.5));
    const ValueId place = builder_.divide(centre, builder_.number(static_cast<double>(side)));
    // Excluded from contraction, so that positions are the same in all formulas.
    builder_.keep(place);
    return place;
}

ValueId CellPlace::builtin(Builtin builtin) {
    const Grid& grid = assembly_.program().domain.grid;
    switch (builtin) {
        case Builtin::x: return coordinate(0, grid.longest_side());
        case Builtin::y: return coordinate(1, grid.longest_side());
        case Builtin::z: return coordinate(2, grid.longest_side());
        case Builtin::sx: return coordinate(0, grid.width);
        case Builtin::sy: return coordinate(1, grid.height);
        case Builtin::sz: return coordinate(2, grid.depth);
        case Builtin::t: return assembly_.time(at_);
        case Builtin::step: return assembly_.step();
        // The normal of a plane is (0, 0, 1).
        case Builtin::nx:
        case Builtin::ny:
        case Builtin::curvature:
        case Builtin::curvature_mean:
        case Builtin::curvature_gauss:
        case Builtin::curvature_high:
        case Builtin::curvature_low: return builder_.number(0);
        case Builtin::nz: return builder_.number(1);
    }
    CHECK(false, "lowering: every built-in value has a meaning");
}

/// The position of a crawling cell, which is stored in species.
Space CellPlace::space_of_tissue() {
    const DomainSettings& domain = assembly_.program().domain;
    const Grid& grid = domain.grid;
    const ItemId place = assembly_.system().cells->place;
    const auto along = [&](std::size_t axis, std::int64_t side, Boundary boundary) {
        const double length = static_cast<double>(side) / static_cast<double>(grid.longest_side());
        const ValueId value = assembly_.item(ItemId(place.index() + axis));
        const bool is_periodic = !domain.model && boundary == Boundary::periodic;
        return SpaceAxis{value, length, is_periodic, domain.model || side > 1};
    };
    return {along(0, grid.width, grid.boundary.x), along(1, grid.height, grid.boundary.y),
            along(2, grid.depth, grid.boundary.z)};
}

Space CellPlace::space() {
    if (assembly_.context().is_tissue()) return space_of_tissue();
    if (assembly_.program().domain.model) {
        const auto along = [&](ModelPlane plane) {
            return SpaceAxis{of_model(plane), 1, false, true};
        };
        return {along(ModelPlane::x), along(ModelPlane::y), along(ModelPlane::z)};
    }
    const Grid& grid = assembly_.program().domain.grid;
    const std::int64_t longest = grid.longest_side();
    const auto along = [&](int axis, std::int64_t side, Boundary boundary) {
        const double length = static_cast<double>(side) / static_cast<double>(longest);
        return SpaceAxis{coordinate(axis, longest), length, boundary == Boundary::periodic,
                         side > 1};
    };
    return {along(0, grid.width, grid.boundary.x), along(1, grid.height, grid.boundary.y),
            along(2, grid.depth, grid.boundary.z)};
}

ValueId CellPlace::content() {
    if (assembly_.context().is_tissue()) return builder_.number(1);
    if (assembly_.program().domain.model) {
        // The last row is filled up with copies of a cell. The area of a copy is 0, and is replaced
        // here because formulas may divide by the area.
        const ValueId area = of_model(ModelPlane::area);
        const ValueId is_copy = builder_.apply(Op::equal, area, builder_.number(0));
        return builder_.select(is_copy, builder_.number(1), area);
    }
    const DomainSettings& domain = assembly_.program().domain;
    return builder_.number(std::pow(domain.grid.spacing, axes_of(domain)));
}

/// The draw word of the cell. Column and row enter the hash separately. The slice does not, so in
/// slices other than the first it changes the draw word.
ValueId CellPlace::draw(ValueId draw) {
    if (assembly_.context().has_links()) {
        builder_.set_cell(of_model(ModelPlane::number));
        return draw;
    }
    if (assembly_.program().domain.grid.depth == 1) return draw;
    const ValueId slice =
        builder_.apply(Op::bits_multiply, builder_.cell_slice(), builder_.word(0x9e3779b9));
    return builder_.apply(Op::bits_xor, draw, slice);
}

}  // namespace cascade::lowering
