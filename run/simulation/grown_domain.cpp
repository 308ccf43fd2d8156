// Evaluates the scales of lengths, which are formulas of time.
#include "run/simulation/grown_domain.h"

#include "lang/program/grown_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

std::array<double, 3> cell_lengths(const Simulation& simulation, std::uint32_t stage) {
    const SimulationDomain& domain = simulation.domain();
    std::array<double, 3> lengths = scales_at(domain.stage(stage), simulation.state(stage).t);
    for (double& length : lengths) length *= domain.grid.spacing;
    return lengths;
}

std::optional<Failure> shrinks_to_nothing(const SimulationDomain& domain, std::uint32_t stage,
                                          double t, double end, double step) {
    constexpr int steps = 100;  // More than the 64 steps from check to check.
    const Stage& its = domain.stage(stage);
    if (!its.growth) return std::nullopt;
    for (int n = 0; n <= steps; ++n) {
        const double moment = std::min(t + n * step, end);
        const auto scales = scales_at(its, moment);
        for (const GrowingSide& side : growing_sides(domain.program->domain)) {
            const double scale = scales[side.axis];
            if (scale > 0 && std::isfinite(scale)) continue;
            return Failure{
                fmt::format("stage '{}' ({}): the domain shrinks to nothing: {} would be {:.6g} "
                            "at t = {:.6g}",
                            its.name, domain.program->system_of(stage).name, side.name,
                            side.start * scale, moment),
                "a length must stay above 0 while the stage runs"};
        }
    }
    return std::nullopt;
}

}  // namespace cascade
