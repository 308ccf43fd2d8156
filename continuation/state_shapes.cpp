// The directions in which states can be moved, and simple symmetric changes of states.
#include "continuation/steady_problem.h"

#include <algorithm>

namespace cascade::continuation {

void SteadyProblem::find_areas(const DomainCells& cells) {
    areas_ = Vector::Ones(cell_count());
    if (cells.areas.empty()) return;
    Index to = 0;
    for (std::size_t k = 0; k < cells.areas.size(); ++k) {
        if (cells.inside.empty() || cells.inside[k]) areas_[to++] = cells.areas[k];
    }
    areas_ /= areas_.mean();
}

/// Finds the axes along which states can be moved.
void SteadyProblem::find_free_axes() {
    for (const int axis : grid_->axes().present) {
        const Index step = grid_->shift(Offset::along(axis, 1));
        const auto goes_on = [&](Index cell) { return grid_->is_inside(cell + step); };
        const bool is_moved = is_periodic_[static_cast<std::size_t>(axis)] &&
                              grid_->length(axis) > 2 &&
                              std::ranges::all_of(grid_->cells(), goes_on);
        if (is_moved && rates_->is_same_along(axis) && sides_->is_same_along(axis)) {
            free_axes_.push_back(axis);
        }
    }
}

/// Finds the rotations by which states can be moved.
void SteadyProblem::find_turns(const DomainCells& cells) {
    if (rates_->has_places()) return;
    for (const auto& velocity : cells.turns) {
        SparseRows turn(grid_->size(), grid_->size());
        for (int axis = 0; axis < 3; ++axis) {
            const auto& along = velocity[static_cast<std::size_t>(axis)];
            const Values factors = Eigen::Map<const Values>(along.data(), grid_->size());
            turn += scaled(factors, rates_->differences().gradient_over_links(axis));
        }
        turns_.push_back(std::move(turn));
    }
}

/// The derivative of a state along a rotation.
Vector SteadyProblem::turned(const SparseRows& turn, const Vector& state) const {
    Vector derivative(size());
    for (Index s = 0; s < species_count(); ++s) {
        Vector values = Vector::Zero(grid_->size());
        for (Index k = 0; k < cell_count(); ++k) {
            values[grid_->cells()[static_cast<std::size_t>(k)]] = state[k * species_count() + s];
        }
        const Vector changes = turn * values;
        for (Index k = 0; k < cell_count(); ++k) {
            derivative[k * species_count() + s] =
                changes[grid_->cells()[static_cast<std::size_t>(k)]];
        }
    }
    return derivative;
}

/// The derivative of a state along an axis whose sides are periodic.
Vector SteadyProblem::shifted(int axis, const Vector& state) const {
    std::vector<Index> numbers(static_cast<std::size_t>(grid_->size()), 0);
    for (Index k = 0; k < cell_count(); ++k) {
        numbers[static_cast<std::size_t>(grid_->cells()[static_cast<std::size_t>(k)])] = k;
    }
    const auto length = static_cast<Index>(grid_->length(axis));
    const Index step = grid_->shift(Offset::along(axis, 1));
    Vector derivative(size());
    for (Index k = 0; k < cell_count(); ++k) {
        const Index cell = grid_->cells()[static_cast<std::size_t>(k)];
        const auto at = static_cast<Index>(grid_->position(cell, axis));
        const auto number = [&](Index to) {
            return numbers[static_cast<std::size_t>(cell + (to - at) * step)];
        };
        const Index next = number((at + 1) % length);
        const Index before = number((at + length - 1) % length);
        for (Index s = 0; s < species_count(); ++s) {
            derivative[k * species_count() + s] =
                (state[next * species_count() + s] - state[before * species_count() + s]) /
                (2 * grid_->spacing());
        }
    }
    return derivative;
}

std::vector<Vector> SteadyProblem::motions(const Vector& state) const {
    std::vector<Vector> all;
    for (const int axis : free_axes_) all.push_back(shifted(axis, state));
    for (const SparseRows& turn : turns_) all.push_back(turned(turn, state));
    return all;
}

std::vector<Vector> SteadyProblem::even_shapes(const Vector& like) const {
    Index strongest = 0;
    like.cwiseAbs().maxCoeff(&strongest);
    const Index species = strongest % species_count();
    std::vector<Vector> shapes;
    const auto add = [&](const auto& is_in) {
        Vector shape = Vector::Zero(size());
        for (Index k = 0; k < cell_count(); ++k) {
            const Index cell = grid_->cells()[static_cast<std::size_t>(k)];
            if (is_in(cell)) shape[k * species_count() + species] = 1;
        }
        shapes.push_back(std::move(shape));
    };
    for (const int axis : grid_->axes().present) {
        add([&](Index cell) { return grid_->position(cell, axis) == 0; });
    }
    add([&](Index cell) { return cell == grid_->cells().front(); });
    return shapes;
}

}  // namespace cascade::continuation
