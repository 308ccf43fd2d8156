// The checker. Checks first the systems, then the stages in order, and then the domain and the
// picture.
#include "lang/check/check.h"

#include "lang/program/models.h"

#include "lang/check/check_dimensions.h"
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/blocks/check_growth.h"
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_coarse.h"
#include "lang/check/blocks/check_shape.h"
#include "lang/check/systems/check_solver.h"
#include "lang/check/blocks/check_side_values.h"
#include "lang/check/systems/check_time.h"
#include "lang/check/expressions/user_functions.h"
#include "lang/library/library.h"
#include "lang/program/grown_lengths.h"
#include "lang/program/stage_kinds.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

using checking::Workspace;

/// Reports library systems that have no meaning in this domain. A system may be correct and still
/// have no meaning: for example, a curl is a number in the plane but a vector in volumes.
void report_unfit(Workspace& work, const ast::Script& script, const ast::Block& system) {
    const auto report = [&](const ast::Word& base) {
        if (base.text != system.name.text) return;
        work.diagnostics.error(base.span,
                               fmt::format("'{}' does not work in this domain", base.text),
                               "the messages about its equations say why");
    };
    for (const ast::Block& block : script.blocks) {
        report(block.base);
        for (const ast::Word& base : block.joined) report(base);
    }
}

/// Checks the script's own systems and the library systems that the script names. `library`
/// contains the parsed scripts of the library, and must outlive the workspace. Blocks of cells are
/// checked after systems of fields, because they read stages of fields by name.
void check_systems(Workspace& work, const ast::Script& script,
                   const std::vector<LibraryScript>& library) {
    std::vector<checking::SystemBlock> blocks;
    for (const LibraryScript& each : library) {
        blocks.push_back({&each.script, &each.script.blocks[each.block], true});
    }
    for (const ast::Block& block : script.blocks) {
        if (block.kind == ast::BlockKind::system) blocks.push_back({&script, &block, false});
    }
    const std::vector<checking::DerivedSystem> systems = checking::derive_systems(work, blocks);
    checking::add_stages(work, script, [&](std::string_view name) {
        return std::ranges::any_of(systems, [&](const checking::DerivedSystem& each) {
            return each.from.block->name.text == name && each.from.block->is_cells;
        });
    });
    // For each element of `systems`, its id in the program.
    std::vector<SystemId> numbers(systems.size());
    for (const bool is_of_cells : {false, true}) {
        for (std::size_t k = 0; k < systems.size(); ++k) {
            const checking::DerivedSystem& each = systems[k];
            if (each.from.block->is_cells != is_of_cells) continue;
            std::optional<SystemId> base;
            if (each.base) base = numbers[*each.base];
            std::vector<SystemId> joined;
            for (const std::size_t other : each.joined) joined.push_back(numbers[other]);
            const std::size_t errors_before = work.diagnostics.error_count();
            numbers[k] = checking::check_system(work, each, base, std::move(joined));
            checking::check_system_sides(work, *each.from.script, *each.from.block, numbers[k],
                                         base);
            const bool is_sound = work.diagnostics.error_count() == errors_before;
            if (!is_sound && each.from.built_in) report_unfit(work, script, *each.from.block);
        }
        checking::find_systems_of_stages(work, script, false);
    }
}

bool has_cells(const ast::Script& script, const std::vector<LibraryScript>& library) {
    const auto is_of_cells = [](const ast::Block& block) { return block.is_cells; };
    return std::ranges::any_of(script.blocks, is_of_cells) ||
           std::ranges::any_of(library, [&](const LibraryScript& each) {
               return is_of_cells(each.script.blocks[each.block]);
           });
}

bool measures_on_surface(const DomainSettings& domain) {
    return domain.surface && domain.surface->has_metric;
}

Workspace workspace_of(const Program& program, Diagnostics& diagnostics) {
    Workspace work{program, diagnostics, {}, {}, {}, {}, {}, 0};
    work.on_surface = measures_on_surface(program.domain);
    for (const System& system : program.systems) {
        work.names.push_back(checking::names_of(system));
    }
    for (std::uint32_t i = 0; i < program.stages.size(); ++i) {
        work.lengths_grow |= program.stages[i].growth.has_value();
        work.stages.emplace(program.stages[i].name, i);
        work.cell_stages.push_back(is_of_cells(program, i));
    }
    return work;
}

}  // namespace

std::optional<Program> check(const ast::Script& script, Sources& sources, Diagnostics& diagnostics,
                             NameUses* uses) {
    Program program;
    Diagnostics own;
    {
        Workspace work{program, own, {}, {}, {}, {}, {}, 0};
        work.draft = &program;
        work.units = units_of(script);
        work.measured = MeasuredSpans(script);
        work.uses = uses;
        const std::vector<LibraryScript> library = read_library(script, sources, own);
        ast::Script functions;
        if (has_cells(script, library)) {
            functions = read_cell_functions(sources, own);
            work.cell_functions = &functions;
        }
        checking::check_domain(work, script);
        work.on_surface = measures_on_surface(program.domain);
        work.lengths_grow = checking::lengths_may_grow(program, script);
        check_systems(work, script, library);
        checking::functions_of(work, script);  // This also checks functions that are never called.
        checking::check_names_of_constants(work, script);
        checking::check_stages(work, script);
        checking::check_stage_sides(work, script);
        checking::check_picture(work, script, checking::check_shapes(work, script, sources));
        // After errors, warnings about unread names would be wrong, because expressions that read a
        // name may be missing from the program.
        if (!own.has_errors() && !diagnostics.has_errors()) {
            check_dimensions(script, sources, program, own);
            checking::warn_unread(work);
            checking::check_growth(program, own);
        }
        if (!own.has_errors() && !diagnostics.has_errors()) {
            let_lengths_grow(program);
            checking::check_side_values(program, own);
            for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
                const Span solver = program.stages[k].time.solver_span;
                checking::check_semi_implicit(program, k, solver, own);
                checking::check_local_solver(program, k, solver, own);
            }
            checking::check_coarse_grids(program, own);
            if (has_meaning_on_domain(program, own)) checking::check_sizes(program, own);
        }
    }
    for (Diagnostic& diagnostic : own.sorted()) diagnostics.add(std::move(diagnostic));
    if (diagnostics.has_errors()) return std::nullopt;
    return program;
}

std::optional<Formula> check_view(const ast::Script& script, ast::Expression expression,
                                  std::uint32_t stage, std::uint32_t last_stage,
                                  const Program& program, const Sources& sources,
                                  Diagnostics& diagnostics) {
    Workspace work = workspace_of(program, diagnostics);
    work.units = units_of(script);
    work.measured = MeasuredSpans(script);
    // The functions of cells are read only if there are cells, because reading them needs a search
    // through all sources. A session has a source for each brush stroke, so there may be many
    // sources.
    const bool has_cells = std::ranges::any_of(program.systems, [](const System& system) {
        return system.cells.has_value();
    });
    const ast::Script functions = has_cells ? cell_functions_of(sources) : ast::Script();
    if (!functions.functions.empty()) work.cell_functions = &functions;
    checking::Scope scope;
    scope.context = checking::Context::picture;
    scope.stage = stage;
    const auto& growth = program.stages[stage].growth;
    scope.system = growth ? growth->written : program.stages[stage].system;
    scope.last_stage = last_stage;
    auto checked = checking::check_expression(work, script, expression, scope);
    if (!checked) return std::nullopt;
    if (!checking::can_grow(program, stage, checked->formula, diagnostics)) return std::nullopt;
    checked->formula = with_growth(program, stage, checked->formula);
    if (!has_meaning_on_domain(program, checked->formula, program.system_of(stage), diagnostics)) {
        return std::nullopt;
    }
    return std::move(checked->formula);
}

}  // namespace cascade
