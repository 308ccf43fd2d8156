// Every matrix has a row and a column for each cell of the padded grid.
#include "continuation/differences.h"

namespace cascade::continuation {

namespace {

/// The kinds of matrices, for keys.
enum Kind : int { cells, neighbour, faces, tangents, fluxes };

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

const SparseRows& Differences::in_cells(Difference difference, int first, int second,
                                        const Boundaries& beyond) {
    const Key key{cells, static_cast<int>(difference) * 9 + first * 3 + second, number_of(beyond),
                  0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Taps taps = taps_of(difference, grid_.axes(), first, second);
    const double factor = 1 / taps.size(grid_.spacing());
    const std::vector<Index> sources = grid_.sources(beyond);
    Entries entries;
    for (Index row = 0; row < grid_.size(); ++row) {
        for (const Tap& tap : taps.taps) {
            entries.emplace_back(row, sources[static_cast<std::size_t>(row)] + grid_.shift(tap.at),
                                 factor * tap.weight);
        }
    }
    return known_[key] = made(entries);
}

const SparseRows& Differences::beside(Offset offset, const Boundaries& beyond) {
    const Key key{neighbour, static_cast<int>(offset.number()), number_of(beyond), 0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const std::vector<Index> sources = grid_.sources(beyond);
    Entries entries;
    for (Index row = 0; row < grid_.size(); ++row) {
        entries.emplace_back(row, sources[static_cast<std::size_t>(row)] + grid_.shift(offset), 1);
    }
    return known_[key] = made(entries);
}

/// Whether the face after a cell belongs to a cell of the grid.
bool Differences::is_face(Index cell, int axis) const {
    for (int other = 0; other < 3; ++other) {
        const std::int64_t at = grid_.position(cell, other);
        if (at >= grid_.length(other) || at < (other == axis ? -1 : 0)) return false;
    }
    return true;
}

const SparseRows& Differences::at_faces(Difference difference, int axis) {
    const Key key{faces, static_cast<int>(difference), axis, 0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Taps taps = taps_of(difference, grid_.axes(), axis);
    const double factor = 1 / taps.size(grid_.spacing());
    Entries entries;
    for (Index row = 0; row < grid_.size(); ++row) {
        if (!is_face(row, axis)) continue;
        for (const Tap& tap : taps.taps) {
            entries.emplace_back(row, row + grid_.shift(tap.at), factor * tap.weight);
        }
    }
    return known_[key] = made(entries);
}

const SparseRows& Differences::along_faces(int axis, int component) {
    const Key key{tangents, axis, component, 0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Index next = grid_.shift(Offset::along(axis, 1));
    const Index aside = grid_.shift(Offset::along(component, 1));
    const double factor = 1 / (4 * grid_.spacing());
    Entries entries;
    for (Index row = 0; row < grid_.size(); ++row) {
        if (!is_face(row, axis)) continue;
        for (const Index cell : {row, row + next}) {
            entries.emplace_back(row, cell + aside, factor);
            entries.emplace_back(row, cell - aside, -factor);
        }
    }
    return known_[key] = made(entries);
}

const SparseRows& Differences::between_faces(int axis, const Boundaries& beyond) {
    const Key key{fluxes, axis, number_of(beyond), 0};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Index before = grid_.shift(Offset::along(axis, -1));
    const std::vector<Index> sources = grid_.sources(beyond);
    Entries entries;
    for (Index row = 0; row < grid_.size(); ++row) {
        const Index cell = sources[static_cast<std::size_t>(row)];
        entries.emplace_back(row, cell, 1 / grid_.spacing());
        entries.emplace_back(row, cell + before, -1 / grid_.spacing());
    }
    return known_[key] = made(entries);
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

}  // namespace cascade::continuation
