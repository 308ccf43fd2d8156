// Compares the step with its stability limits at the start and before the failure. Then advises the
// user to choose shorter steps or to check the formulas.
#include "run/stage/not_finite.h"

#include "core/counted_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade {

namespace {

/// A value of at least this magnitude counts as growing without bound.
constexpr double most_that_is_sane = 1e4;

/// Returns the smaller of the stability limits at the start and before the failure, or an empty
/// optional if neither state has a limit. If the state before the failure has grown far beyond the
/// starting values, it is ignored, because any reaction looks stiff in such a state.
std::optional<double> limit(const NotFiniteReport& report) {
    const auto start = longest_step(report.estimate_at_start, report.use);
    const bool is_spoiled =
        report.largest_before.value_or(0) > 100 * std::max(1.0, report.largest_at_start);
    if (is_spoiled) return start;
    const auto before = longest_step(report.estimate_before, report.use);
    if (start && before) return std::min(*start, *before);
    return start ? start : before;
}

/// Returns advice for values that grew without bound although steps were stable. Either the
/// equations make the values grow, or steps are too long to follow the equations.
std::string advice_for_growth(const StepInUse& use) {
    if (is_adaptive(use.solver)) return "the reaction itself grows without bound here";
    return "either the reaction itself grows without bound here, or the steps are too long; "
           "'solver: rk23' chooses the length of steps by their error";
}

}  // namespace

double largest_magnitude(std::span<const Field> species) {
    double largest = 0;
    for (const Field& field : species) {
        field.visit([&](const auto& plane) {
            for_each_cell([&](double value) { largest = std::max(largest, std::abs(value)); },
                          plane);
        });
    }
    return largest;
}

Failure describe(const NotFiniteReport& report) {
    Failure failure;
    if (report.found.at_start()) {
        failure.message =
            fmt::format("stage '{}' ({}): the starting value of {} is not finite at {}",
                        report.stage, report.system, report.species, report.place);
        failure.hint = "look for a division by zero, or a logarithm or root of a negative number";
        return failure;
    }
    const std::string when =
        report.found.is_exact()
            ? fmt::format("after step {}", report.found.step)
            : fmt::format("between steps {} and {}", report.found.last_finite, report.found.step);
    failure.message = fmt::format("stage '{}' ({}): {} is not finite any more at {}, {}",
                                  report.stage, report.system, report.species, report.place, when);
    const StepInUse& use = report.use;
    if (is_semi_implicit(use.solver)) {
        failure.hint = fmt::format(
            "{} is stable for diffusion at any step, but not for the reaction; try 'speed: {:.2g}'",
            name_of(use.solver), use.speed / 2);
        return failure;
    }
    if (is_locally_implicit(use.solver)) {
        failure.hint = fmt::format(
            "{} is stable for a reaction that decays at any step, but not for diffusion or "
            "growth; try 'speed: {:.2g}'",
            name_of(use.solver), use.speed / 2);
        return failure;
    }
    const auto largest = limit(report);
    if (largest && is_too_long(use, *largest)) {
        failure.hint = advise(*largest, use);
    } else if (!report.largest_before) {
        failure.hint =
            "use a smaller grid to see the step and the reason: on this grid, no copy of the "
            "species is kept";
    } else if (*report.largest_before < most_that_is_sane) {
        failure.hint = fmt::format(
            "no value was above {:.3g} before that step: look for a division by zero, or a "
            "logarithm or root of a negative number, in its rate or in a parameter",
            *report.largest_before);
    } else {
        failure.hint = advice_for_growth(use);
    }
    return failure;
}

}  // namespace cascade
