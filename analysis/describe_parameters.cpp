// One line for each parameter.
#include "analysis/describe_parameters.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade::analysis {

std::string class_name(const std::optional<Stability>& stability) {
    return stability ? std::string(name_of(*stability)) : "no flat state";
}

std::string describe(const Program& program, std::uint32_t stage, const ParameterScan& scan) {
    const System& system = program.system_of(stage);
    std::string text =
        fmt::format("{} = {:.5g} ({:.5g} to {:.5g}): {}", system.item_name(scan.span.item),
                    scan.present, scan.span.low, scan.span.high,
                    class_name(scan.changes.empty() ? scan.at_low : scan.changes[0].below));
    if (scan.changes.empty()) return text + " all the way";
    for (const CriticalValue& change : scan.changes) {
        text += fmt::format(", {} above {:.5g}", class_name(change.above), change.value);
        if (std::isfinite(change.cells)) text += fmt::format(" ({:.4g} cells)", change.cells);
    }
    return text;
}

}  // namespace cascade::analysis
