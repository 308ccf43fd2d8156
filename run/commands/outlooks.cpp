// Predicts before a run which stages cannot lead to a pattern.
#include "run/commands/outlooks.h"

#include "analysis/negative_diffusion.h"
#include "analysis/outlook.h"
#include "run/simulation/other_cells.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

std::string outlook(const Program& program, std::uint32_t stage) {
    if (program.system_of(stage).cells) return "";
    if (const auto words = analysis::negative_diffusion(program, stage)) {
        return fmt::format("stage '{}': {}", program.stages[stage].name, *words);
    }
    // Before the trial run, the lengths of a stage with a `size` are not scaled. The trial run will
    // show whether any pattern grows.
    const auto& size = program.stages[stage].size;
    if (size && size->factor == 1) return "";
    const auto reason = analysis::why_nothing_grows(program, stage);
    if (!reason) return "";
    return fmt::format("stage '{}': nothing will grow: {}", program.stages[stage].name, *reason);
}

std::vector<std::string> outlooks(const Script& script) {
    std::vector<std::string> remarks;
    if (script.program->stages.empty()) return remarks;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        std::string remark = outlook(program_of_stage(script, *script.program, k), k);
        if (!remark.empty()) remarks.push_back(std::move(remark));
    }
    return remarks;
}

}  // namespace cascade
