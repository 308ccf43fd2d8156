// Fronts that the grid holds in place are found by four cells in a row, along each axis, wherever
// they pass the middle of the range.
#include "run/simulation/end_remarks.h"

#include "lang/program/nodes_of_rates.h"
#include "run/simulation/stage_view.h"
#include "run/simulation/tissue_stage.h"
#include "run/stage/bound_kernel.h"
#include "run/stage/stage_remarks.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

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

bool is_of_neighbours(const Node& node) { return node.is<Call>() && differentiates(node.function); }

/// Is every parameter the same in all cells?
bool is_uniform_in_space(const Stage& stage, const System& system) {
    return std::ranges::all_of(system.quantities.ids(), [&](ItemId item) {
        return system.is_species(item) || stage.uniform[item];
    });
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
    if (!is_uniform_in_space(view.stage(), system)) return false;
    const auto is_place = [](const Node& node) {
        return is_draw(node) || (node.is<Builtin>() && !is_moment(node)) || node.is<StageItem>();
    };
    return !holds_in_rates(system, is_place) && holds_in_rates(system, is_of_neighbours);
}

/// A remark if almost all fronts of a species jump from one level to another within a cell, and do
/// not move.
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

/// Does a stage end with the values that it began with, because its rates are 0 everywhere?
bool has_stood_still(const StageView& view) {
    const StageState& state = view.state();
    const StageCourse& course = state.course;
    if (!state.done || course.empty() || course.last().step != state.steps) return false;
    const auto is_same = [](const Spread& a, const Spread& b) {
        return a.mean == b.mean && a.squares == b.squares && a.smallest == b.smallest &&
               a.largest == b.largest;
    };
    const auto& first = course.first().species;
    if (!std::equal(first.begin(), first.end(), course.last().species.begin(), is_same))
        return false;
    const std::vector<Field> rates = view.rates();
    return std::all_of(rates.begin(), rates.end(), [&](const Field& rate) {
        return root_mean_square(rate, view.environment().counted()) == 0;
    });
}

}  // namespace

std::string remark_on(const Simulation& simulation, std::uint32_t k) {
    const StageView view = simulation.own_view(k);
    if (view.state().tissue) return remark_on_cells(view);
    const Environment& here = view.environment();
    const std::string remark = describe_end(view.stage(), view.system(), view.state(),
                                            k == here.script.final_stage(), here.counted());
    if (!remark.empty()) return remark;
    if (!has_stood_still(view)) return find_pinned_fronts(view).value_or("");
    return fmt::format(
        "stage '{}' ended as it began: its rates are 0 in all cells{}", view.stage().name,
        here.grid.height == 1 && !here.model ? "; on a line derivatives along y are 0" : "");
}

bool made_its_pattern(const Simulation& simulation, std::uint32_t k) {
    // A species whose deviation has grown by this factor owes its pattern to the stage.
    constexpr double times_at_start = 3;
    const Stage& stage = simulation.domain().stage(k);
    const System& system = simulation.domain().program->system_of(k);
    if (system.cells) return false;
    if (!is_uniform_in_space(stage, system) || holds_in_rates(system, is_draw) ||
        !holds_in_rates(system, is_of_neighbours)) {
        return false;
    }
    const StageCourse& course = simulation.state(k).course;
    if (course.empty()) return false;
    for (std::size_t s = 0; s < course.last().species.size(); ++s) {
        const Spread &first = course.first().species[s], &last = course.last().species[s];
        const bool is_made = last.is_even(course.last().largest[s]) ||
                             last.deviation() >= times_at_start * first.deviation();
        if (!is_made) return false;
    }
    return true;
}

}  // namespace cascade
