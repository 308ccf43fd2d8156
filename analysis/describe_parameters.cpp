// Writes one line for each parameter.
#include "analysis/describe_parameters.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade::analysis {

std::string class_name(const std::optional<Stability>& stability) {
    return stability ? std::string(name_of(*stability)) : "no flat state";
}

namespace {

/// A text such as "spots high in u, stripes from 6.9".
std::string pattern_words(const System& system, const ParameterScan& scan,
                          const CriticalValue& change) {
    if (!change.amplitudes) return "";
    const AmplitudeEquations& by = *change.amplitudes;
    // If third-order terms do not limit growth, the coefficients do not show what limits it.
    if (!by.is_supercritical()) return "begins by a jump";
    if (!by.has_plane()) return "grows smoothly";
    if (by.quadratic == 0) {
        return by.ends_in_stripes() ? "stripes, grow smoothly" : "spots or squares";
    }
    // Finds the first species that takes part in the wave. Components below `least_part` are
    // rounding errors.
    constexpr double least_part = 1e-3;
    int first = 0;
    while (first + 1 < by.wave.size() && !(std::abs(by.wave[first]) > least_part)) ++first;
    const bool is_high = (by.quadratic > 0) == (by.wave[first] > 0);
    const ItemId species = system.species()[SpeciesId(static_cast<std::uint32_t>(first))];
    std::string text =
        fmt::format("spots {} in {}", is_high ? "high" : "low", system.quantities[species].name);
    if (change.stripes >= scan.span.low && change.stripes <= scan.span.high) {
        text += fmt::format(", stripes from {:.4g}", change.stripes);
    }
    return text;
}

}  // namespace

std::string describe(const Program& program, std::uint32_t stage, const ParameterScan& scan) {
    const System& system = program.system_of(stage);
    std::string text =
        fmt::format("{} = {:.5g} ({:.5g} to {:.5g}): {}", system.item_name(scan.span.item),
                    scan.present, scan.span.low, scan.span.high,
                    class_name(scan.changes.empty() ? scan.at_low : scan.changes[0].below));
    if (scan.changes.empty()) return text + " all the way";
    for (const CriticalValue& change : scan.changes) {
        text += fmt::format(", {} above {:.5g}", class_name(change.above), change.value);
        if (!std::isfinite(change.cells)) continue;
        const std::string pattern = pattern_words(system, scan, change);
        text +=
            fmt::format(" ({:.4g} cells{}{})", change.cells, pattern.empty() ? "" : ": ", pattern);
    }
    return text;
}

}  // namespace cascade::analysis
