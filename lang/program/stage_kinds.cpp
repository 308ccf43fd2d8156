// Finds the kind of a stage from its system.
#include "lang/program/stage_kinds.h"

#include <algorithm>

namespace cascade {

namespace {

bool is_of_cells(const Program& program, const Stage& stage) {
    return stage.system < program.systems.next() && program.systems[stage.system].cells;
}

std::optional<std::uint32_t> stage_before(const Program& program, std::uint32_t stage,
                                          bool has_cells) {
    while (stage-- > 0) {
        if (is_of_cells(program, stage) == has_cells) return stage;
    }
    return std::nullopt;
}

}  // namespace

bool is_of_cells(const Program& program, std::uint32_t stage) {
    return is_of_cells(program, program.stages[stage]);
}

bool has_stage_of_cells(const Program& program) {
    return std::ranges::any_of(program.stages,
                               [&](const Stage& stage) { return is_of_cells(program, stage); });
}

bool has_stage_of_fields(const Program& program) {
    return !std::ranges::all_of(program.stages,
                                [&](const Stage& stage) { return is_of_cells(program, stage); });
}

std::optional<std::uint32_t> stage_of_cells_before(const Program& program, std::uint32_t stage) {
    return stage_before(program, stage, true);
}

std::optional<std::uint32_t> stage_of_fields_before(const Program& program, std::uint32_t stage) {
    return stage_before(program, stage, false);
}

}  // namespace cascade
