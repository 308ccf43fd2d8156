// Collects the stages of a script and finds their systems.
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/expressions/user_functions.h"
#include "lang/check/names/unknown_names.h"
#include "lang/check/names/note_uses.h"
#include "lang/library/library.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

namespace {

constexpr std::size_t most_stages = 1000;

void add_stage(Workspace& work, const ast::Block& block, bool has_cells) {
    const auto index = static_cast<std::uint32_t>(work.program.stages.size());
    Stage stage;
    stage.system = unknown_system;
    stage.span = block.name.empty() ? block.keyword.span : block.name.span;
    stage.name =
        block.name.empty() ? fmt::format("stage{}", index + 1) : std::string(block.name.text);
    const auto [first, is_new] = work.stages.try_emplace(stage.name, index);
    if (!is_new) {
        report_twice(work, stage.span, work.program.stages[first->second].span,
                     fmt::format("there are two stages '{}'", stage.name));
    }
    note_use(work, stage.span, stage.span);
    work.draft->stages.push_back(std::move(stage));
    work.cell_stages.push_back(has_cells);
}

}  // namespace

std::vector<const ast::Block*> stage_blocks(const ast::Script& script) {
    std::vector<const ast::Block*> blocks;
    for (const ast::Block& block : script.blocks) {
        const bool is_stage =
            block.kind == ast::BlockKind::stage || block.kind == ast::BlockKind::classic_stage;
        if (is_stage && blocks.size() < most_stages) blocks.push_back(&block);
    }
    return blocks;
}

void add_stages(Workspace& work, const ast::Script& script,
                const std::function<bool(std::string_view)>& has_cells) {
    const std::vector<const ast::Block*> blocks = stage_blocks(script);
    for (const ast::Block* block : blocks) add_stage(work, *block, has_cells(block->base.text));
    if (blocks.size() < most_stages) return;
    const auto end = std::ranges::find_if(script.blocks, [&](const ast::Block& block) {
        const bool is_stage =
            block.kind == ast::BlockKind::stage || block.kind == ast::BlockKind::classic_stage;
        return is_stage && &block > blocks.back();
    });
    if (end == script.blocks.end()) return;
    work.diagnostics.error(end->keyword.span,
                           fmt::format("a script has at most {} stages", most_stages));
}

void find_systems_of_stages(Workspace& work, const ast::Script& script, bool all_are_known) {
    const std::vector<const ast::Block*> blocks = stage_blocks(script);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const ast::Word& name = blocks[k]->base;
        const auto found = work.systems.find(std::string(name.text));
        if (found != work.systems.end()) {
            work.draft->stages[k].system = found->second;
            if (found->second != unknown_system)
                note_use(work, name.span, work.program.systems[found->second].span);
        } else if (all_are_known && !name.empty() && !lacks_names(script)) {
            report_unknown_system(work, name);
        }
    }
}

}  // namespace cascade::checking
