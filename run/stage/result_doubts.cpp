// Each message says what was seen, and suggests a shorter step if a limit is known.
#include "run/stage/result_doubts.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

std::optional<std::string> describe(const ChequerboardReport& report) {
    std::string text =
        fmt::format("stage '{}': {} alternates from cell to cell like a chequerboard", report.stage,
                    report.species);
    const auto limit = longest_step(report.estimate, report.use);
    if (limit && is_too_long(report.use, *limit)) {
        return text + ", which is a fault of too large a time step and not a pattern; " +
               advise(*limit, report.use);
    }
    if (report.flickers) {
        return text + fmt::format(
                          ", and jumps back and forth from step to step: the time step is too "
                          "large; try 'speed: {:.2g}'",
                          report.use.speed / 2);
    }
    if (!limit && report.estimate.eigenvalue > 0 && !is_partly_implicit(report.use.solver)) {
        return text +
               ", because its rate makes differences of neighbours grow, the faster the finer they "
               "are: is a sign wrong?";
    }
    return std::nullopt;
}

std::string describe(const FlickerReport& report) {
    std::string text = fmt::format("stage '{}': {} jumps back and forth from step to step",
                                   report.stage, report.species);
    if (report.part >= flicker_threshold) {
        text += fmt::format(", by up to {:.3g} in {:.0f} % of the cells", report.largest,
                            std::max(1.0, 100 * report.part));
    }
    text += ", which is a fault of too large a time step; ";
    const StepInUse& use = report.use;
    if (report.limit && is_too_long(use, *report.limit)) return text + advise(*report.limit, use);
    if (!(use.speed > 0)) return text + "make 'speed' smaller";
    return text + fmt::format("try 'speed: {:.2g}'", use.speed / 2);
}

std::string describe(const AstrayReport& report) {
    const StepInUse& use = report.use;
    const std::string text = fmt::format(
        "stage '{}': the time step is too large: {} more steps would move {} by {:.2g}, and {} "
        "steps of a third of the length by {:.2g}, to values that differ by {:.2g}; ",
        report.stage, report.steps, report.species, report.change, report.shorter_steps,
        report.change_of_shorter, report.apart);
    if (report.limit && is_too_long(use, *report.limit)) return text + advise(*report.limit, use);
    return text + fmt::format("try 'speed: {:.2g}'", use.speed / 3);
}

std::optional<std::string> describe(const SolveReport& report, const std::string& unknown,
                                    const std::string& stage) {
    constexpr double largest_rest = 1e-3, largest_mean = 1e-3;
    if (!(report.largest_rest <= largest_rest)) {
        return fmt::format(
            "stage '{}': the constraint of {} was not solved: after {} iterations its residual was "
            "{:.2g} of that without {}; its operator may have no inverse, or its coefficients may "
            "differ too much",
            stage, unknown, report.most_iterations, report.largest_rest, unknown);
    }
    if (!(report.largest_mean <= largest_mean)) {
        return fmt::format(
            "stage '{}': no {} balances the mean of its constraint, {:.2g} of the whole, as any "
            "constant may be added to it; it was found for the rest, and its own mean is 0",
            stage, unknown, report.largest_mean);
    }
    return std::nullopt;
}

std::string describe(const LostChangeReport& report) {
    return fmt::format(
        "stage '{}': a step would change {} by about {:.2g}, which is too small to be added to "
        "values of {:.2g} in single precision; about {:.2g} is lost over the stage; "
        "'precision: double' in the domain keeps it",
        report.stage, report.species, report.change, report.value, report.lost);
}

}  // namespace cascade
