// The program for the smaller cells differs from the script's program only in the end and the step
// of one stage.
#include "run/simulation/finer_run.h"

#include "run/simulation/other_cells.h"
#include "run/simulation/stage_start.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

constexpr std::int64_t most_settling_steps = 1'000'000'000;

/// Whether the solver would become unstable in finer cells unless `speed` is reduced. If `speed` is
/// uniform, Euler's steps are divided automatically when they are too long (StageTimer::substeps).
bool needs_shorter_steps(const Stage& stage, bool has_uniform_speed) {
    const Solver solver = stage.time.solver;
    if (stage.time.chooses_steps() || takes_long_steps(solver)) return false;
    return solver != Solver::euler || !has_uniform_speed;
}

/// Returns a program in which the stage continues for a fraction of the time that it has taken.
Program settling_program(const Program& program, std::uint32_t k, const StageState& end) {
    Program result = program;
    Stage& stage = result.stages[k];
    const std::int64_t detail = program.domain.detail;
    const ItemId speed = program.system_of(k).speed_item();
    const bool is_timed = stage.uniform[speed];
    const bool is_shorter = needs_shorter_steps(stage, is_timed);
    if (is_shorter) {
        Formula& formula = stage.items[speed];
        const Node whole = formula.nodes.back();
        Node product{Call{}, whole.span, whole.type, Function::divide, 2, {}};
        product.operands[0] = NodeId(formula.nodes.size() - 1);
        product.operands[1] = formula.nodes.next();
        formula.nodes.push_back(Node{static_cast<double>(detail * detail), whole.span});
        formula.nodes.push_back(product);
    }
    stage.time.until.reset();  // `until` may be true already, and would then end the stage at once.
    stage.time.open_end = false;
    stage.time.every = 0;
    stage.time.duration.reset();
    stage.time.duration_in_steps.reset();
    if (is_timed) {
        stage.time.duration = end.t * (1 + settling_part);
        stage.iterations = most_settling_steps;
    } else {
        const auto more =
            static_cast<std::int64_t>(std::ceil(static_cast<double>(end.steps) * settling_part));
        stage.iterations = std::min(most_settling_steps, end.steps + more * detail * detail);
    }
    return result;
}

/// Finds the items that contain a random number drawn in each cell, directly or through other
/// items.
class DrawnItems {
public:
    DrawnItems(const Program& program, std::uint32_t stage) : system_(program.system_of(stage)) {
        drawn_.assign(system_.item_count(), false);
        for (const ItemId item : program.stages[stage].order)
            drawn_[item] = holds_draw(program.stages[stage].items[item]);
    }

    bool contains(ItemId item) const { return drawn_[item]; }

private:
    bool holds_draw(const Formula& formula) const {
        return std::any_of(formula.nodes.begin(), formula.nodes.end(), [&](const Node& node) {
            if (const auto* item = node.as<ItemId>()) return bool{drawn_[*item]};
            if (const auto* definition = node.as<DefinitionId>())
                return holds_draw(system_.definitions[*definition].formula);
            return is_draw_in_cell(node);
        });
    }

    const System& system_;
    IdVector<ItemId, bool> drawn_;
};

/// Gives a stage that was started in finer cells the state that was transferred to these cells.
void take_moment(const Program& program, std::uint32_t k, StageState carried, StageState& state) {
    const System& system = program.system_of(k);
    const DrawnItems drawn(program, k);
    FieldState &from = carried.fields(), &into = state.fields();
    for (const ItemId item : system.items()) {
        const bool is_carried = drawn.contains(item) && item != system.speed_item();
        if (!is_carried || from.parameters[item].empty()) continue;
        if (item == system.frozen_item()) into.frozen = std::move(from.frozen);
        into.parameters[item] = std::move(from.parameters[item]);
    }
    for (const ItemId item : system.species()) {
        const std::size_t s = state.species_of_item[item]->index();
        Field& values = from.species[s];
        // Frozen cells keep their starting values, which were computed again in the finer cells,
        // with sharp outlines.
        if (!drawn.contains(item)) keep_frozen(values, into.frozen, into.species[s]);
        into.species[s] = std::move(values);
    }
    state.go_to(carried.steps, carried.t);
}

}  // namespace

std::unique_ptr<CellCarrier> carrier_to_finer(const Environment& from, const Environment& here) {
    if (from.model) return carrier_on_model(*from.model->cells, *here.model->cells, here.team);
    return carrier_to_finer(from.grid, here.program->domain.detail, from.inside(), here.inside());
}

Result<void> settle_in_finer_cells(Environment& here, std::span<StageState> into, std::uint32_t k) {
    here.use(settling_program(*here.program, k, into[k]));
    StageState carried = std::move(into[k]);
    if (auto started = start_stage(here, into, k); !started) return started;
    take_moment(*here.program, k, std::move(carried), into[k]);
    return {};
}

}  // namespace cascade
