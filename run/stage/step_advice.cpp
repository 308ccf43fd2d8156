// Suggests a speed of nine tenths of the limit, rounded to two digits. Also suggests the number of
// iterations that covers the same time.
#include "run/stage/step_advice.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade {

namespace {

/// Returns the speed to suggest: nine tenths of the limit, rounded to two digits.
double safe_speed(double limit) { return std::stod(fmt::format("{:.2g}", 0.9 * limit)); }

/// Returns `; iterations: N` with the number of steps that cover the same time.
std::string iterations_for(double speed, const StepInUse& use) {
    const double count = std::ceil(static_cast<double>(use.iterations) * use.speed / speed);
    const bool is_possible = use.iterations > 0 && use.speed > speed && count <= 1e9;
    return is_possible ? fmt::format("; iterations: {}", static_cast<std::int64_t>(count)) : "";
}

}  // namespace

std::optional<double> longest_step(const StabilityEstimate& estimate, const StepInUse& use) {
    if (!estimate.largest_speed || is_partly_implicit(use.solver)) return std::nullopt;
    const std::uint32_t stages = is_stabilised(use.solver) ? most_stages : 1;
    const double limit = *estimate.largest_speed * stability_interval(use.solver, stages) / 2;
    if (limit < 1e-9 * use.speed) return std::nullopt;
    return limit;
}

bool is_too_long(const StepInUse& use, double limit) {
    return std::isnan(use.speed) || limit < 1.1 * use.speed;
}

std::string advise(double limit, const StepInUse& use) {
    const std::string used =
        std::isnan(use.speed) ? "varies by cell" : fmt::format("is {:.6g}", use.speed);
    const double speed = safe_speed(limit);
    std::string text = fmt::format(
        "the largest stable speed is about {:.3g}, and the speed of this stage {}; try 'speed: "
        "{}{}'",
        limit, used, speed, iterations_for(speed, use));
    if (use.diffusion_limits && !std::isnan(use.speed)) {
        text += ", or longer steps: 'solver: rkl2; speed: auto";
        // The suggested duration replaces the setting `iterations`.
        if (use.iterations > 0) {
            text +=
                fmt::format("; duration: {:.6g}", static_cast<double>(use.iterations) * use.speed);
        }
        text += "'";
    }
    return text;
}

}  // namespace cascade
