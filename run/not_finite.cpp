#include "run/not_finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade {

namespace {

/// What has grown without bound has passed this before it is infinite.
constexpr double most_that_is_sane = 1e4;

/// A speed to try: nine tenths of the limit, two digits.
double safe_speed(double largest) { return std::stod(fmt::format("{:.2g}", 0.9 * largest)); }

std::string advice(double largest, double speed) {
    const std::string used = std::isnan(speed) ? "varies by cell" : fmt::format("is {:.6g}", speed);
    return fmt::format("the largest stable speed is about {:.3g} and this stage's {}; try 'speed: {}'",
                       largest, used, safe_speed(largest));
}

/// The smaller of the two limits; empty where neither state has one.
std::optional<double> limit(const NotFiniteReport& report) {
    const auto start = report.estimate_at_start.largest_speed;
    const auto before = report.estimate_before.largest_speed;
    if (start && before) return std::min(*start, *before);
    return start ? start : before;
}

/// A limit well above the speed in use did not make the run fail.
bool explains(double largest, double speed) { return std::isnan(speed) || largest < 1.1 * speed; }

}  // namespace

double largest_magnitude(const std::vector<Field>& species) {
    double largest = 0;
    for (const Field& field : species) {
        field.visit([&](const auto& plane) {
            for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
                for (std::int64_t column = 0; column < plane.layout().width; ++column) {
                    const double value = plane.row(row)[column];
                    largest = std::max(largest, std::abs(value));
                }
            }
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
    failure.message = fmt::format("stage '{}' ({}): {} is not finite any more at {}, {}", report.stage,
                                  report.system, report.species, report.place, when);
    if (!report.semi_implicit.empty()) {
        failure.hint = fmt::format("{} takes diffusion alone for a step of any length, the reaction not; "
                                   "try 'speed: {:.2g}'", report.semi_implicit, report.speed / 2);
        return failure;
    }
    const auto largest = limit(report);
    if (largest && explains(*largest, report.speed)) {
        failure.hint = advice(*largest, report.speed);
    } else if (!report.largest_before) {
        failure.hint = "a smaller grid needs no memory to be spared, so it tells which step it was and why";
    } else if (*report.largest_before < most_that_is_sane) {
        failure.hint = fmt::format(
            "no value was above {:.3g} before that step: look for a division by zero, or a logarithm "
            "or root of a negative number, in its rate or in a parameter",
            *report.largest_before);
    } else {
        failure.hint = "the reaction itself grows without bound here";
        if (largest) {
            failure.hint += fmt::format(" (diffusion is stable up to a speed of about {:.3g})", *largest);
        }
    }
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
