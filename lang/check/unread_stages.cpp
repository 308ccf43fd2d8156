// Marks the stages that formulas and the picture read, and warns of all other stages.
#include "lang/check/unread_stages.h"
#include "lang/program/cell_items.h"
#include "lang/program/stage_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace cascade {

namespace {

void note_reads(const Formula& formula, std::vector<bool>& is_read) {
    for (const Node& node : formula.nodes) {
        if (const auto* earlier = node.as<StageItem>()) is_read[earlier->stage] = true;
        if (const auto* sensed = node.as<SensedItem>()) is_read[sensed->item.stage] = true;
    }
}

std::vector<std::string> species_of(const System& system) {
    std::vector<std::string> names;
    for (const Quantity& quantity : system.quantities) {
        if (quantity.is_species) names.push_back(quantity.name);
    }
    return names;
}

/// A hint that shows how the next stage can continue from this stage.
std::string how_to_go_on(const Program& program, std::uint32_t stage) {
    const Stage& next = program.stages[stage + 1];
    const bool has_cells = is_of_cells(program, stage);
    if (has_cells != is_of_cells(program, stage + 1)) {
        return has_cells ? ""
                         : fmt::format("cells can read it at their positions by {}.{}",
                                       program.stages[stage].name,
                                       species_of(program.system_of(stage)).front());
    }
    if (has_cells) return "without 'founders' the next stage continues with these cells";
    const std::vector<std::string> species = species_of(program.system_of(stage));
    const bool is_alike = species == species_of(program.system_of(stage + 1));
    const bool is_family = std::any_of(species.begin(), species.end(), [](const std::string& name) {
        return name.find('[') != std::string::npos;
    });
    if (!is_alike || is_family || species.size() > 4) {
        return fmt::format("use 'p: {}.{}' in a later stage to begin with values of this stage",
                           program.stages[stage].name, species.front());
    }
    std::vector<std::string> statements;
    for (const std::string& name : species) statements.push_back(fmt::format("{}: {}", name, name));
    return fmt::format("use '{}' in stage '{}' to continue from it", fmt::join(statements, "; "),
                       next.name);
}

}  // namespace

void warn_of_unread_stages(const Program& program, std::span<const PictureView> views,
                           Diagnostics& diagnostics) {
    if (program.stages.empty()) return;
    std::vector<bool> is_read(program.stages.size());
    is_read.back() = true;
    for (const PictureView& view : views) {
        is_read[view.stage] = true;
        if (view.formula) note_reads(*view.formula, is_read);
    }
    for (const Stage& stage : program.stages) {
        for (const Formula& item : stage.items) note_reads(item, is_read);
        note_reads(stage.show, is_read);
        note_reads(stage.remove, is_read);
        note_reads(stage.body, is_read);
        if (stage.founders) note_reads(stage.founders->chance, is_read);
        if (stage.time.until) note_reads(*stage.time.until, is_read);
        const System& system = program.systems[stage.system];
        for (const Definition& each : system.definitions) note_reads(each.formula, is_read);
        for (const Formula& rate : system.rates) note_reads(rate, is_read);
        for (const Formula* rule : rules_of(system)) note_reads(*rule, is_read);
        for (const auto& sides : stage.sides) {
            for (const SideSetting& side : sides) note_reads(side.value, is_read);
        }
        for (const DefinitionSides& each : stage.definition_sides) {
            for (const SideSetting& side : each.sides) note_reads(side.value, is_read);
        }
    }
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (is_read[k]) continue;
        diagnostics.warning(program.stages[k].span,
                            fmt::format("no later stage and no picture reads stage '{}'",
                                        program.stages[k].name),
                            how_to_go_on(program, k));
    }
}

}  // namespace cascade
