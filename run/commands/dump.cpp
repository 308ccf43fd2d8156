// Calls the function that prints the requested kind of dump. Each function is in the folder of the
// data that it prints.
#include "run/commands/dump.h"

#include "ir/cell_kernel.h"
#include "lang/check/dimensionless_groups.h"
#include "lang/equations/equation_symbols.h"
#include "lang/equations/equations.h"
#include "lang/lower/lower.h"
#include "lang/syntax/parse.h"
#include "lang/syntax/token.h"
#include "jit/jit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace cascade {

namespace {

constexpr std::array<std::string_view, 10> kinds = {"tokens",  "ast",   "equations", "tex",
                                                    "program", "graph", "plan",      "ir",
                                                    "llvm",    "asm"};

/// Options that make the same plans as a run.
constexpr PlanOptions as_run{Materialise::when_cheaper, false, true};

std::string dump_tokens(const Script& script) {
    Diagnostics already_reported;
    return print_tokens(lex(0, script.sources, already_reported), script.sources);
}

/// Returns the words ", pass 2 of 3", or an empty string if the plan has a single pass.
std::string pass_words(const StepPlan& plan, std::size_t pass) {
    if (plan.passes.size() == 1) return "";
    return fmt::format(", pass {} of {}", pass + 1, plan.passes.size());
}

std::string dump_ir(const Program& program) {
    std::string text;
    const auto section = [&](const Stage& stage, std::string_view what, const StepPlan& plan) {
        for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
            if (plan.passes[pass].bound.kernel->results.empty()) continue;
            text += fmt::format("# stage '{}': {}{}\n{}\n", stage.name, what,
                                pass_words(plan, pass), print(*plan.passes[pass].bound.kernel));
        }
    };
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const Stage& stage = program.stages[k];
        section(stage, "values that are the same everywhere", plan_uniform_start(program, k));
        section(stage, "values that vary", plan_start(program, k));
        section(stage, "what no step changes", plan_step_invariants(program, k, as_run));
        section(stage, "one step", plan_step(program, k, as_run));
    }
    return text;
}

/// Writes a dimensionless group in TeX as a fraction of powers.
std::string group_in_tex(const DimensionlessGroup& group) {
    const Symbols symbols{Notation::tex, true, {}, {}};
    std::string above, below;
    for (const GroupFactor& factor : group) {
        const std::int64_t power = std::abs(factor.power);
        std::string text = symbols.name(factor.name);
        if (power != 1) text += fmt::format("^{{{}}}", power);
        std::string& part = factor.power > 0 ? above : below;
        part += (part.empty() ? "" : " \\, ") + text;
    }
    if (above.empty()) above = "1";
    return below.empty() ? above : fmt::format("\\frac{{{}}}{{{}}}", above, below);
}

/// Writes a sentence with the dimensionless groups of the first stage of a system. If units are
/// missing, writes a comment that names the values without a unit. Returns an empty string if no
/// stage uses the system or there are no groups.
std::string groups_in_tex(const Script& script, const ProgramUnits& units, SystemId system) {
    const Program& program = *script.program;
    const auto stage = std::ranges::find(program.stages, system, &Stage::system);
    if (stage == program.stages.end()) return "";
    const auto found =
        dimensionless_groups(units, program,
                             static_cast<std::uint32_t>(stage - program.stages.begin()));
    if (!found.without_unit.empty()) {
        return fmt::format("% dimensionless groups need units, and there is none for {}\n",
                           fmt::join(found.without_unit, ", "));
    }
    std::string text;
    for (const DimensionlessGroup& group : found.groups) {
        text += fmt::format("{}${}$", text.empty() ? "" : ",\n  ", group_in_tex(group));
    }
    return text.empty() ? "" : fmt::format("Dimensionless groups: {}.\n", text);
}

/// Writes the equations of the systems that stages use. If the script has no stages, writes the
/// equations of all systems that the script defines.
std::string dump_equations(const Script& script, Notation notation) {
    const Program& program = *script.program;
    IdVector<SystemId, bool> shown(program.systems.size(), false);
    for (const Stage& stage : program.stages) shown[stage.system] = true;
    std::vector<std::string_view> names;
    std::vector<SystemId> ids;
    for (const SystemId id : program.systems.ids()) {
        const System& system = program.systems[id];
        if (program.stages.empty() ? system.built_in : !shown[id]) continue;
        names.push_back(system.name);
        ids.push_back(id);
    }
    const ProgramUnits units = units_of_program(script.tree, program);
    const auto equations =
        print_equations(script.tree, script.sources, names, notation, EquationParts::all);
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (!text.empty()) text += '\n';
        if (notation == Notation::unicode) text += fmt::format("{}\n", names[k]);
        text += equations[k];
        if (notation == Notation::tex) text += groups_in_tex(script, units, ids[k]);
    }
    return text;
}

Result<std::string> dump_code(const Program& program, bool assembly) {
    std::string text;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const StepPlan plan = plan_step(program, k, as_run);
        const Stencil stencil = program.domain.grid.stencil();
        for (std::size_t pass = 0; pass < plan.passes.size(); ++pass) {
            const CellKernel& kernel = *plan.passes[pass].bound.kernel;
            auto code =
                assembly ? dump_assembly(kernel, stencil, {}) : dump_llvm(kernel, stencil, {});
            if (!code) return code;
            text += fmt::format("{} stage '{}': one step{}\n{}\n", assembly ? '#' : ';',
                                program.stages[k].name, pass_words(plan, pass), *code);
        }
    }
    return text;
}

}  // namespace

std::span<const std::string_view> dump_kinds() { return kinds; }

Result<std::string> dump(const Script& script, std::string_view kind) {
    if (kind == "tokens") return dump_tokens(script);
    if (kind == "ast") return print_ast(script.tree, script.sources);
    if (!script.program) return failure("a wrong script has no program to show");
    if (kind == "program") return print_program(*script.program);
    if (kind == "equations") return dump_equations(script, Notation::unicode);
    if (kind == "tex") return dump_equations(script, Notation::tex);
    if (kind == "graph") return describe_graphs(*script.program);
    if (kind == "plan") return describe_plans(*script.program);
    if (kind == "ir") return dump_ir(*script.program);
    return dump_code(*script.program, kind == "asm");
}

}  // namespace cascade
