// Every matrix has a row and a column for each cell of the padded grid.
#include "continuation/differences.h"

#include "core/check.h"

namespace cascade::continuation {

namespace {

/// The kinds of matrices, as parts of keys.
enum Kind : int { cells, neighbour, faces, tangents, fluxes, links };

int number_of(const Boundaries& beyond) {
    const auto is_periodic = [](Boundary each) { return each == Boundary::periodic ? 1 : 0; };
    return is_periodic(beyond.x) + 2 * is_periodic(beyond.y) + 4 * is_periodic(beyond.z);
}

}  // namespace

SparseRows Differences::made(const Entries& entries) const {
    SparseRows matrix(grid_.size(), grid_.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// Collects the entries of a difference. Neighbours outside of the mask are replaced as kernels
/// replace them.
struct Differences::Taking {
    const PaddedGrid& grid;
    Entries inside = {}, once = {}, twice = {};

    void add(Index row, Index cell, Offset at, double weight) {
        const auto is_inside = [&](Offset offset) {
            return grid.is_inside(cell + grid.shift(offset));
        };
        if (!grid.has_outside() || at.is_own() || is_inside(at)) {
            inside.emplace_back(row, cell + grid.shift(at), weight);
            return;
        }
        const Offset along_x{at.dx, 0, 0}, along_y{0, at.dy, 0}, along_z{0, 0, at.dz};
        const Offset first = along_x.is_own() ? along_y : along_x;
        const Offset second = along_z.is_own() ? along_y : along_z;
        if (first == at || second == at) {
            once.emplace_back(row, cell, weight);
            return;
        }
        const bool has_first = is_inside(first), has_second = is_inside(second);
        const double share = has_first && has_second ? 0.5 * weight : weight;
        if (has_first) once.emplace_back(row, cell + grid.shift(first), share);
        if (has_second) once.emplace_back(row, cell + grid.shift(second), share);
        if (!has_first && !has_second) twice.emplace_back(row, cell, weight);
    }
};

Reads Differences::made(const Taking& taking) const {
    Reads reads{made(taking.inside), {}, {}, {}};
    if (!grid_.has_outside()) return reads;
    reads.inside = reads.all;
    reads.once = made(taking.once);
    reads.twice = made(taking.twice);
    reads.all += reads.once;
    reads.all += reads.twice;
    return reads;
}

const Reads& Differences::in_cells(Difference difference, int first, int second,
                                   const Boundaries& beyond) {
    const Key key{cells, static_cast<int>(difference) * 9 + first * 3 + second, number_of(beyond),
                  0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Taps taps = taps_of(difference, grid_.axes(), first, second);
    const double factor = 1 / taps.size(grid_.spacing());
    const std::vector<Index> sources = grid_.sources(beyond);
    Taking taking{grid_};
    for (Index row = 0; row < grid_.size(); ++row) {
        const Index cell = sources[static_cast<std::size_t>(row)];
        if (!grid_.is_inside(cell)) continue;
        for (const Tap& tap : taps.taps) taking.add(row, cell, tap.at, factor * tap.weight);
    }
    return known_[key] = made(taking);
}

const Reads& Differences::beside(Offset offset, const Boundaries& beyond) {
    const Key key{neighbour, static_cast<int>(offset.number()), number_of(beyond), 0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const std::vector<Index> sources = grid_.sources(beyond);
    Taking taking{grid_};
    for (Index row = 0; row < grid_.size(); ++row) {
        const Index cell = sources[static_cast<std::size_t>(row)];
        if (grid_.is_inside(cell)) taking.add(row, cell, offset, 1);
    }
    return known_[key] = made(taking);
}

/// Whether the face after a cell belongs to a cell of the grid.
bool Differences::is_face(Index cell, int axis) const {
    for (int other = 0; other < 3; ++other) {
        const std::int64_t at = grid_.position(cell, other);
        if (at >= grid_.length(other) || at < (other == axis ? -1 : 0)) return false;
    }
    return true;
}

const Reads& Differences::at_faces(Difference difference, int axis) {
    const Key key{faces, static_cast<int>(difference), axis, 0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Taps taps = taps_of(difference, grid_.axes(), axis);
    const double factor = 1 / taps.size(grid_.spacing());
    const Offset step = Offset::along(axis, 1), back = Offset::along(axis, -1);
    Taking taking{grid_};
    for (Index row = 0; row < grid_.size(); ++row) {
        if (!is_face(row, axis)) continue;
        const bool is_inside = grid_.is_inside(row);
        if (!is_inside && !grid_.is_inside(row + grid_.shift(step))) continue;
        for (const Tap& tap : taps.taps) {
            // Offsets are relative to this cell of the face, or to the other one if only the other
            // is in the domain.
            if (is_inside) taking.add(row, row, tap.at, factor * tap.weight);
            else taking.add(row, row + grid_.shift(step), tap.at + back, factor * tap.weight);
        }
    }
    return known_[key] = made(taking);
}

const Reads& Differences::along_faces(int axis, int component) {
    const Key key{tangents, axis, component, 0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Offset step = Offset::along(axis, 1);
    const double factor = 1 / (4 * grid_.spacing());
    Taking taking{grid_};
    for (Index row = 0; row < grid_.size(); ++row) {
        if (!is_face(row, axis)) continue;
        const Index next = row + grid_.shift(step);
        for (const int side : {1, -1}) {
            const Offset aside = Offset::along(component, side);
            const Offset there = aside + step, here = aside + Offset::along(axis, -1);
            const bool first = grid_.is_inside(row), second = grid_.is_inside(next);
            if (!first && !second) continue;
            if (first) taking.add(row, row, aside, side * factor);
            else taking.add(row, next, here, side * factor);
            if (second) taking.add(row, next, aside, side * factor);
            else taking.add(row, row, there, side * factor);
        }
    }
    return known_[key] = made(taking);
}

const SparseRows& Differences::between_faces(int axis, const Boundaries& beyond) {
    const Key key{fluxes, axis, number_of(beyond), 0};
    if (const auto found = others_.find(key); found != others_.end()) return found->second;
    const Index before = grid_.shift(Offset::along(axis, -1));
    const std::vector<Index> sources = grid_.sources(beyond);
    Entries entries;
    for (Index row = 0; row < grid_.size(); ++row) {
        const Index cell = sources[static_cast<std::size_t>(row)];
        entries.emplace_back(row, cell, 1 / grid_.spacing());
        entries.emplace_back(row, cell + before, -1 / grid_.spacing());
    }
    return others_[key] = made(entries);
}

Values Differences::on_side(int side) const {
    const int axis = side / 2;
    const std::int64_t at = side % 2 == 0 ? -1 : grid_.length(axis) - 1;
    Values values = Values::Zero(grid_.size());
    for (Index cell = 0; cell < grid_.size(); ++cell) {
        if (grid_.position(cell, axis) == at) values[cell] = 1;
    }
    return values;
}

Values Differences::within_border(int axis) const {
    const Index next = grid_.shift(Offset::along(axis, 1));
    Values values = Values::Zero(grid_.size());
    for (Index cell = 0; cell < grid_.size(); ++cell) {
        if (is_face(cell, axis) && grid_.is_inside(cell) && grid_.is_inside(cell + next)) {
            values[cell] = 1;
        }
    }
    return values;
}

SparseRows Differences::linked(const double* weights) const {
    CHECK(weights != nullptr, "the cells of a model have links with weights");
    constexpr std::int64_t slice_cells = LinkTable<double>::slice_cells;
    const LinkTable<double> table = grid_.links()->table<double>();
    const std::int64_t width = grid_.length(0);
    const std::int64_t slices = (width + slice_cells - 1) / slice_cells;
    const std::int64_t stride = slices * slice_cells + 2 * PlaneLayout::row_pad;
    Entries entries;
    for (const Index cell : grid_.cells()) {
        const std::int64_t column = cell % width, row = cell / width;
        const std::int64_t slice = row * slices + column / slice_cells;
        for (std::uint32_t entry = table.starts[slice]; entry < table.starts[slice + 1]; ++entry) {
            const std::int64_t link = slice_cells * entry + column % slice_cells;
            if (weights[link] == 0) continue;
            const std::int64_t target = table.target(link);
            entries.emplace_back(cell, target / stride * width + target % stride, weights[link]);
            entries.emplace_back(cell, cell, -weights[link]);
        }
    }
    return made(entries);
}

const SparseRows& Differences::over_links() {
    const Key key{links, -1, 0, 0};
    if (const auto found = others_.find(key); found != others_.end()) return found->second;
    return others_[key] = linked(grid_.links()->table<double>().weights);
}

const SparseRows& Differences::gradient_over_links(int component) {
    const Key key{links, component, 0, 0};
    if (const auto found = others_.find(key); found != others_.end()) return found->second;
    const auto& gradients = grid_.links()->table<double>().gradients;
    return others_[key] = linked(gradients[static_cast<std::size_t>(component)]);
}

}  // namespace cascade::continuation
