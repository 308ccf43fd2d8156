// Moments are times. Only stages whose `speed` is the same in all cells have a time, and so have
// moments.
#include "run/commands/moments.h"

#include "lang/syntax/script_units.h"
#include "run/commands/run_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cascade {

double next_moment(const Moments& moments, double start, double t) {
    double next = std::numeric_limits<double>::infinity();
    for (const double moment : moments.at) {
        if (moment - start > t) next = std::min(next, moment - start);
    }
    if (moments.every > 0) {
        constexpr double rounding = 1e-9;
        const double passed = std::floor((start + t) / moments.every + rounding);
        next = std::min(next, (passed + 1) * moments.every - start);
    }
    return next;
}

Result<Moments> moments_in(const ast::Script& script, const MomentsRequest& request) {
    const ScriptUnits units = units_of(script);
    Moments moments;
    for (const GivenTimes* const given : {&request.at, &request.every}) {
        std::optional<Unit> unit;
        if (!given->unit.empty()) {
            unit = unit_of(given->unit);
            if (unit->dimension != Dimension::of(BaseQuantity::time)) {
                return failure(fmt::format("'{}' is not a unit of time", given->unit));
            }
            if (!units.knows(BaseQuantity::time)) {
                return failure(
                    fmt::format("the times are in {}, but the script has no unit of time",
                                given->unit),
                    "leave the unit out, or give a 'duration' of the script a unit");
            }
        }
        for (const double number : given->numbers) {
            const double time = unit ? units.convert(number, *unit) : number;
            if (given == &request.every) moments.every = time;
            else moments.at.push_back(time);
        }
    }
    return moments;
}

NextMoment moments_of(const Moments& moments, const Simulation& simulation, std::uint32_t stage) {
    if (!moments.any()) return {};
    double start = 0;
    for (std::uint32_t k = 0; k < stage; ++k) start += time_of(simulation, k);
    return [&moments, start](double t) { return next_moment(moments, start, t); };
}

void check_moments(Script& script, const RunRequest& request) {
    if (!request.moments.any()) return;
    const std::string option =
        flag_of(request.moments.at.numbers.empty() ? RunOption::every : RunOption::at);
    const auto refuse = [&](const std::string& message, const std::string& hint) {
        script.diagnostics.error(option_span(script.sources, option, option), message, hint);
    };
    if (const auto moments = moments_in(script.tree, request.moments); !moments) {
        return refuse(moments.error().message, moments.error().hint);
    }
    const bool is_observed = !request.frames.empty() || !request.series.empty() ||
                             !request.log.expressions.empty() || films_steps(request) ||
                             request.model_files.animate || request.picture.space_time;
    if (!is_observed) {
        return refuse("this option needs an output over time, but none is requested",
                      "add --series NAME.npy, --log EXPR, --frames FOLDER or -o NAME.gif");
    }
    const std::string hint =
        "leave the option out to observe the stage by steps, at each "
        "'interval'";
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        const Stage& stage = script.program->stages[k];
        const System& system = script.program->system_of(k);
        if (system.cells || stage.uniform[system.speed_item()]) continue;
        return refuse(
            fmt::format("stage '{}' has no time, because its speed differs from cell to cell",
                        stage.name),
            hint);
    }
}

}  // namespace cascade
