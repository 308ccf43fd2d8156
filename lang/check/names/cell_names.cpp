// Resolves names in systems of crawling cells: the built-in values of a cell, and the quantities of
// other stages that cells may read.
#include "lang/check/names/check_names.h"
#include "lang/program/stage_kinds.h"

#include <fmt/format.h>

namespace cascade::checking {

bool is_of_cells(const Workspace& work, const Scope& scope) {
    if (scope.context == Context::shape) return true;
    const auto& systems = work.program.systems;
    return scope.system < systems.next() && systems[scope.system].cells;
}

bool is_of_each_cell(std::string_view name) {
    return cell_value_named(name) || name == "p" || name == "r" || name == "age";
}

std::optional<Node> resolve_cell_value(Workspace& work, const Scope& scope, CellValue value,
                                       Span span) {
    Diagnostic diagnostic;
    if (scope.context == Context::bound) {
        diagnostic.message = "a bound can contain only numbers and parameters";
    } else if (scope.context == Context::value && is_of_frame(value)) {
        diagnostic.message = fmt::format("'{}' has no value when a stage starts",
                                         cell_value_names[static_cast<std::size_t>(value)]);
        diagnostic.hint = "read it in rates, definitions and pictures";
    } else {
        return Node{value, span, is_vector(value) ? ValueType::vector : ValueType::number};
    }
    diagnostic.span = span;
    add_call(work, diagnostic);
    work.diagnostics.add(std::move(diagnostic));
    return std::nullopt;
}

bool knows_cells(Workspace& work, const Scope& scope, StageItem item, Span span) {
    const Program& program = work.program;
    const Stage& source = program.stages[item.stage];
    if (!source.uniform.empty() && source.uniform[item.item]) return true;
    if (!is_of_cells(work, scope)) {
        report(work, span, "a stage of fields cannot read values of cells that crawl",
               fmt::format("stage '{}' consists of cells that crawl", source.name));
        return false;
    }
    if (scope.context == Context::picture) {
        report(work, span,
               fmt::format("stage '{}' does not continue the cells of '{}'", source.name,
                           program.stages[*scope.stage].name),
               "continue the value in the next stage, as in c: c, to show it");
        return false;
    }
    const auto before = stage_of_cells_before(program, *scope.stage);
    if (program.stages[*scope.stage].founders) {
        report(work, span,
               fmt::format("stage '{}' has cells of its founders, not the cells of '{}'",
                           program.stages[*scope.stage].name, source.name),
               "leave 'founders' out to continue with the cells of the stage before");
        return false;
    }
    if (before == item.stage) return true;
    report(work, span,
           fmt::format("the cells of '{}' now belong to stage '{}'", source.name,
                       program.stages[*before].name),
           "continue the value in every stage between the two, as in c: c");
    return false;
}

std::optional<std::uint32_t> find_sensed_stage(Workspace& work, const ast::Qualified& qualified) {
    const std::string_view name = qualified.stage.text;
    const auto found = work.stages.find(std::string(name));
    if (found == work.stages.end()) {
        std::vector<std::string> names;
        for (const Stage& each : work.program.stages) names.push_back(each.name);
        report(work, qualified.stage.span, fmt::format("there is no stage '{}'", name),
               is_hopeless(work) ? "" : did_you_mean(work, name, names));
        return std::nullopt;
    }
    if (!work.cell_stages[found->second]) return found->second;
    report(work, qualified.stage.span, "cells can read only stages of fields",
           fmt::format("stage '{}' consists of cells that crawl", name));
    return std::nullopt;
}

}  // namespace cascade::checking
