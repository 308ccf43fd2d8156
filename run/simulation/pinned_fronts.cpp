// Looks at four cells in a row, along each axis, wherever they pass the middle of the range.
#include "run/simulation/pinned_fronts.h"

#include "lang/program/nodes_of_rates.h"
#include "run/stage/bound_kernel.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace cascade {

namespace {

/// A front is thinner than a cell if values change by this part of their range between two cells,
/// and by little to both sides of them.
constexpr double least_jump_of_front = 0.8, most_beside = 0.05;
/// Of all fronts this part must be thin.
constexpr double mostly_thin = 0.9;
/// A front that would move by less than this number of cells in the time of the stage stands still.
constexpr double least_way = 0.5;

struct Fronts {
    double all = 0, thin = 0;
    double speed = 0;  ///< Sum over thin ones, in cells per unit of time.
};

class FrontSearch {
public:
    FrontSearch(const Field& values, const Field* rates, const Spread& spread)
        : values_(values),
          rates_(rates),
          range_(spread.largest - spread.smallest),
          middle_((spread.largest + spread.smallest) / 2) {}

    Fronts search() {
        const PlaneLayout& layout = values_.layout();
        const std::array<std::int64_t, 3> cells{layout.width, layout.height,
                                                layout.row_count() / layout.height};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Cell cell{};
            for (cell[2] = 0; cell[2] < cells[2]; ++cell[2]) {
                for (cell[1] = 0; cell[1] < cells[1]; ++cell[1]) {
                    for (cell[0] = 0; cell[0] < cells[0]; ++cell[0]) {
                        if (cell[axis] + 3 < cells[axis]) look_at(cell, axis);
                    }
                }
            }
        }
        return fronts_;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    static double at(const Field& field, Cell cell, std::size_t axis, std::int64_t further) {
        cell[axis] += further;
        return field.number_at(cell[0], cell[1], cell[2]);
    }

    void look_at(const Cell& cell, std::size_t axis) {
        const auto value = [&](std::int64_t n) { return at(values_, cell, axis, n); };
        const double b = value(1), c = value(2);
        if (!((b - middle_) * (c - middle_) < 0)) return;
        ++fronts_.all;
        const bool is_thin = std::abs(c - b) >= least_jump_of_front * range_ &&
                             std::abs(value(0) - b) <= most_beside * range_ &&
                             std::abs(value(3) - c) <= most_beside * range_;
        if (!is_thin) return;
        ++fronts_.thin;
        if (rates_ == nullptr) return;
        fronts_.speed +=
            (std::abs(at(*rates_, cell, axis, 1)) + std::abs(at(*rates_, cell, axis, 2))) / range_;
    }

    const Field& values_;
    const Field* rates_;
    double range_, middle_;
    Fronts fronts_;
};

bool are_thin(const Fronts& fronts) {
    return fronts.all > 0 && fronts.thin >= mostly_thin * fronts.all;
}

/// Could what stands there have been put there by anything but the grid?
bool may_be_pinned(const StageView& view) {
    const StageState& state = view.state();
    const System& system = view.system();
    const Environment& here = view.environment();
    if (here.model || here.counted() != nullptr || !state.frozen.empty()) return false;
    if (!state.done || state.course.empty() || state.course.last().step != state.steps)
        return false;
    if (!view.stage().uniform[system.speed_item()] || !system.invariants.empty()) return false;
    for (const ItemId item : system.quantities.ids()) {
        if (!system.is_species(item) && !view.stage().uniform[item]) return false;
    }
    const auto is_place = [](const Node& node) {
        return is_draw(node) || (node.is<Builtin>() && !is_moment(node)) || node.is<StageItem>();
    };
    const auto is_of_neighbours = [](const Node& node) {
        return node.is<Call>() && differentiates(node.function);
    };
    return !holds_in_rates(system, is_place) && holds_in_rates(system, is_of_neighbours);
}

}  // namespace

std::optional<std::string> find_pinned_fronts(const StageView& view) {
    if (!may_be_pinned(view)) return std::nullopt;
    const StageState& state = view.state();
    for (std::size_t k = 0; k < state.species.size(); ++k) {
        const Spread& spread = state.course.last().species[k];
        if (spread.is_even()) continue;
        if (!are_thin(FrontSearch(state.species[k], nullptr, spread).search())) continue;
        const std::vector<Field> rates = view.rates();
        const Fronts fronts = FrontSearch(state.species[k], &rates[k], spread).search();
        if (!(fronts.speed / fronts.thin * state.t < least_way)) continue;
        return fmt::format(
            "stage '{}': the fronts of {} are thinner than a cell and stand still: the grid may "
            "hold them in place; a smaller 'spacing' would show whether they move",
            view.stage().name, species_name(view.system(), k));
    }
    return std::nullopt;
}

}  // namespace cascade
