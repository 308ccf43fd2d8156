#include "run/not_finite.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace cascade {

namespace {

/// A speed to try: nine tenths of the limit, two digits.
double safe_speed(double largest) { return std::stod(fmt::format("{:.2g}", 0.9 * largest)); }

std::string advice(double largest, double speed) {
    const std::string used = std::isnan(speed) ? "varies by cell" : fmt::format("is {:.6g}", speed);
    return fmt::format("the largest stable speed is about {:.3g} and this stage's {}; try 'speed: {}'",
                       largest, used, safe_speed(largest));
}

/// The limit at the start if that explains the failure, else the one just before it.
std::optional<double> limit(const NotFiniteReport& report) {
    const auto start = report.estimate_at_start.largest_speed;
    const auto before = report.estimate_before.largest_speed;
    if (start && (std::isnan(report.speed) || *start < 1.02 * report.speed)) return start;
    if (before && std::isfinite(*before)) return before;
    return start;
}

}  // namespace

Failure describe(const NotFiniteReport& report) {
    const NotFinite& found = report.found;
    Failure failure;
    if (found.step == 0) {
        failure.message =
            fmt::format("stage '{}' ({}): the starting value of {} is not finite at column {}, row {}",
                        report.stage, report.system, report.species, found.column, found.row);
        failure.hint = "look for a division by zero, or a logarithm or root of a negative number";
        return failure;
    }
    failure.message = fmt::format(
        "stage '{}' ({}): {} is not finite any more at column {}, row {}, after step {}",
        report.stage, report.system, report.species, found.column, found.row, found.step);
    const auto largest = limit(report);
    failure.hint = largest ? advice(*largest, report.speed)
                           : "the reaction itself grows without bound: a smaller speed may not help";
    return failure;
}

std::string describe_chequerboard(const std::string& stage, const std::string& species,
                                  const StabilityEstimate& estimate, double speed) {
    std::string text = fmt::format(
        "stage '{}': {} alternates from cell to cell like a chequerboard, which is a fault of too "
        "large a time step and not a pattern",
        stage, species);
    if (estimate.largest_speed) text += "; " + advice(*estimate.largest_speed, speed);
    return text;
}

}  // namespace cascade
