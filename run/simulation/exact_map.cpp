// Examines the rates, and then the values of all cells.
#include "run/simulation/exact_map.h"

#include "lang/program/nodes_of_rates.h"
#include "solvers/field_norms.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// The largest value that a cellular automaton is assumed to reach. Larger values are not accepted
/// as whole numbers, because steps that are too long make values beyond 2^24, and in single
/// precision all of these are whole numbers.
constexpr double largest_state = 1 << 16;

bool holds_whole_numbers(const Field& field, const Mask* inside) {
    const PlaneLayout& layout = field.layout();
    return field.visit([&](const auto& plane) {
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            const std::uint8_t* const counts = inside != nullptr ? inside->row(row) : nullptr;
            const auto* const values = plane.row(row);
            for (std::int64_t i = 0; i < layout.width; ++i) {
                if (counts != nullptr && counts[i] == 0) continue;
                const double value = values[i];
                if (!(std::abs(value) <= largest_state) || value != std::floor(value)) return false;
            }
        }
        return true;
    });
}

}  // namespace

bool knows_its_steps(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    const auto knows = [&](const Node& node) {
        return is_draw(node) || node.is(Builtin::step) || node.is(system.speed_item());
    };
    return holds_in_rates(system, knows) || holds_in_sides(program.stages[stage], knows) ||
           std::any_of(system.invariants.begin(), system.invariants.end(),
                       [&](const Invariant& each) { return holds_in(each.bound, knows); });
}

bool is_exact_map(const StageView& view) {
    const System& system = view.system();
    if (view.stage().time.solver != Solver::euler || view.stage().time.chooses_steps())
        return false;
    if (holds_in_rates(system, is_draw)) return false;
    const auto reads_speed = [&](const Node& node) { return node.is(system.speed_item()); };
    if (holds_in_rates(system, reads_speed)) return true;
    const std::vector<Field>& species = view.state().species();
    return system.invariants.empty() && std::ranges::all_of(species, [&](const Field& field) {
               return holds_whole_numbers(field, view.environment().counted());
           });
}

}  // namespace cascade
