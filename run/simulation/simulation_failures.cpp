// Why a run failed.
#include "lang/calculus/derivative.h"
#include "run/simulation/simulation_implementation.h"
#include "run/stage/not_finite.h"

namespace cascade {

std::string Simulation::Implementation::place_in_words(std::int64_t column,
                                                       std::int64_t row) const {
    if (!model) return fmt::format("column {}, row {}", column, row);
    // The places after the last one are like it.
    const auto last = static_cast<std::int64_t>(model->count()) - 1;
    return fmt::format("cell {}", model->cell_at(std::min(row * grid.width + column, last)));
}

Failure Simulation::Implementation::explain(const StepTooShort& place, std::uint32_t k) const {
    Failure failure;
    failure.message = fmt::format(
        "stage '{}' ({}): steps shrink to nothing: at t = {:.6g} one of {:.2g} is too long still, "
        "for "
        "{} at {}",
        stage(k).name, program->system_of(k).name, place.t, place.step,
        species_name(program->system_of(k), place.species),
        place_in_words(place.column, place.row));
    failure.hint =
        "something jumps or grows without bound there; a larger tolerance or euler may pass it";
    return failure;
}

StepInUse Simulation::Implementation::step_in_use(std::uint32_t k) const {
    const StageTime& time = stage(k).time;
    StepInUse use;
    use.speed = speed_number(k);
    use.solver = time.solver;
    use.is_chosen = time.chooses_steps();
    if (!time.has_duration() && !time.open_end) use.iterations = stage(k).iterations;
    return use;
}

bool Simulation::Implementation::diffusion_limits(std::uint32_t k) const {
    constexpr double worth_changing = 4;
    if (stage(k).time.solver == Solver::symplectic || takes_long_steps(stage(k).time.solver))
        return false;
    const auto bound = jacobian_bound(*program, k, model.get());
    if (!bound || bound->jumps) return false;
    const Formula* const formulas[] = {&bound->whole, &bound->reaction};
    const std::vector<Field> bounds = evaluate(plan_view(*program, formulas, k), k);
    const double whole = bounds[0].number_at(0, 0), reaction = bounds[1].number_at(0, 0);
    return std::isfinite(whole) && whole > worth_changing * reaction;
}

Failure Simulation::Implementation::explain(const StageOutcome& outcome, std::uint32_t k) {
    NotFiniteReport report;
    report.stage = stage(k).name;
    const System& system = program->system_of(k);
    report.system = system.name;
    report.species = species_name(system, outcome.not_finite->species);
    report.found = *outcome.not_finite;
    report.place = place_in_words(report.found.column, report.found.row);
    report.use = step_in_use(k);
    if (report.found.at_start() || is_semi_implicit(report.use.solver)) return describe(report);
    const std::size_t count = states[k].species.size();
    // Without a kept copy the values are those that are spoiled, also where two looks are one step
    // apart.
    const bool keeps = !outcome.last_checked.empty();
    std::vector<Field> last_finite;
    if (keeps) {
        report.estimate_before = stability(k, outcome.last_checked);
        report.largest_before = largest_magnitude(states[k].species);
        last_finite = std::move(states[k].species);
    }
    // A state on its way to infinity says little about the speed that would have been right: the
    // start of the stage is asked as well.
    states[k].species.clear();
    states[k].species.resize(count);
    start_varying_items(k);
    report.largest_at_start = largest_magnitude(states[k].species);
    report.estimate_at_start = stability(k, states[k].species);
    report.use.diffusion_limits = diffusion_limits(k);
    if (keeps) {
        states[k].species = std::move(last_finite);
    } else {
        // What is spoiled is of no use: the stage stands where it began.
        states[k].steps = 0;
        states[k].t = 0;
        states[k].time = {};
    }
    return describe(report);
}

}  // namespace cascade
