// Why a run failed, and what looks as if it will.
#include "run/not_finite.h"
#include "run/simulation_implementation.h"

namespace cascade {

std::string Simulation::Implementation::place_in_words(std::int64_t column, std::int64_t row) const {
    if (!model) return fmt::format("column {}, row {}", column, row);
    // The places behind the last one are like it.
    const auto last = static_cast<std::int64_t>(model->count()) - 1;
    return fmt::format("cell {}", model->cell_at(std::min(row * grid.width + column, last)));
}

Failure Simulation::Implementation::explain(const StepTooShort& place, std::uint32_t k) const {
    Failure failure;
    failure.message = fmt::format(
        "stage '{}' ({}): steps shrink to nothing: at t = {:.6g} one of {:.2g} is too long still, for "
        "{} at {}",
        stage(k).name, program->system_of(k).name, place.t, place.step,
        species_name(program->system_of(k), place.species), place_in_words(place.column, place.row));
    failure.hint = "something jumps or grows without bound there; a larger tolerance or euler may pass it";
    return failure;
}

Failure Simulation::Implementation::explain(const StageOutcome& outcome, std::uint32_t k) {
    NotFiniteReport report;
    report.stage = stage(k).name;
    const System& system = program->system_of(k);
    report.system = system.name;
    report.species = species_name(system, outcome.not_finite->species);
    report.found = *outcome.not_finite;
    report.place = place_in_words(report.found.column, report.found.row);
    report.speed = speed_number(k);
    if (const Solver solver = stage(k).time.solver; is_semi_implicit(solver)) {
        report.semi_implicit = name_of(solver);
    }
    if (report.found.at_start() || !report.semi_implicit.empty()) return describe(report);
    const std::size_t count = states[k].species.size();
    // Without a kept copy the values are those that are spoiled, also where two looks are one step apart.
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
    report.estimate_at_start = stability(k, states[k].species);
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

void Simulation::Implementation::warn_of_chequerboard(std::uint32_t k,
                                                      RunControl& control) const {
    // Cells of a model that lie beside each other in memory need be no neighbours.
    if (!control.warn || states[k].steps == 0 || model) return;
    const System& system = program->system_of(k);
    for (std::size_t s = 0; s < states[k].species.size(); ++s) {
        const Mask* counted = mask ? &mask->inside : nullptr;
        if (chequerboard(states[k].species[s], counted) < chequerboard_threshold) continue;
        // The limit of explicit steps is none of a solver that takes diffusion implicitly.
        const StabilityEstimate limit = is_semi_implicit(stage(k).time.solver)
                                            ? StabilityEstimate{}
                                            : stability(k, states[k].species);
        control.warn(describe_chequerboard(stage(k).name, species_name(system, s), limit,
                                           speed_number(k)));
        return;
    }
}

}  // namespace cascade
