// Estimates the right speed from the last good state and from the start of the stage.
#include "run/simulation/stage_failures.h"

#include "core/parallel.h"
#include "run/simulation/kernel_maker.h"
#include "run/stage/not_finite.h"

#include <fmt/format.h>

#include <span>
#include <utility>
#include <vector>

namespace cascade {
namespace {

Failure explain(const StepTooShort& place, const StageView& view) {
    Failure failure;
    failure.message = fmt::format(
        "stage '{}' ({}): steps shrink to nothing: at t = {:.6g} one of {:.2g} is too long still, "
        "for "
        "{} at {}",
        view.stage().name, view.system().name, place.t, place.step,
        species_name(view.system(), place.species),
        view.environment().place_in_words(place.column, place.row));
    failure.hint =
        "something jumps or grows without bound there; a larger tolerance or euler may pass it";
    return failure;
}

}  // namespace

Failure explain(const StageOutcome& outcome, const StageView& view, StageState& state,
                const std::atomic<bool>& cancel) {
    if (!outcome.not_finite) return explain(*outcome.too_short, view);
    NotFiniteReport report;
    report.stage = view.stage().name;
    report.system = view.system().name;
    report.species = species_name(view.system(), outcome.not_finite->species);
    report.found = *outcome.not_finite;
    report.place = view.environment().place_in_words(report.found.column, report.found.row);
    report.use = view.step_in_use();
    if (report.found.at_start() || is_partly_implicit(report.use.solver)) return describe(report);
    const auto estimate = [&](std::span<const Field> species) {
        StabilityEstimate found;
        const KernelMaker& kernels = *view.environment().kernels;
        complete([&] { found = view.stability(species, kernels.once(), &cancel); });
        return found;
    };
    const std::size_t count = state.species.size();
    // Without a kept copy the values are the spoiled ones, even if two checks are one step apart.
    const bool keeps = !outcome.last_checked.empty();
    std::vector<Field> last_finite;
    if (keeps) {
        report.estimate_before = estimate(outcome.last_checked);
        report.largest_before = largest_magnitude(state.species);
        last_finite = std::move(state.species);
    }
    // A state on its way to infinity says little about the right speed, so the start of the stage
    // is used as well.
    state.species.clear();
    state.species.resize(count);
    state.species = view.starting_species();
    report.largest_at_start = largest_magnitude(state.species);
    report.estimate_at_start = estimate(state.species);
    report.use.diffusion_limits = view.diffusion_limits();
    if (keeps) {
        state.species = std::move(last_finite);
    } else {
        // Spoiled values are of no use: the stage is reset to its start.
        state.time = {};
        state.go_to(0, 0);
    }
    return describe(report);
}

}  // namespace cascade
