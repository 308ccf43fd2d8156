#include "run/compile.h"

#include "core/near_name.h"
#include "lang/lower.h"
#include "run/c_header.h"
#if CASCADE_HAS_JIT
#include "jit/jit.h"
#endif

#include <fmt/format.h>

#include <cctype>
#include <charconv>

namespace cascade {

namespace {

Result<std::uint32_t> find_stage(const Program& program, const std::optional<std::string>& asked) {
    if (program.stages.empty()) return failure("this script has no stage to compile");
    if (!asked) return 0U;
    std::vector<std::string> names;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (program.stages[k].name == *asked) return k;
        names.push_back(program.stages[k].name);
    }
    std::uint32_t number = 0;
    const char* end = asked->data() + asked->size();
    const auto parsed = std::from_chars(asked->data(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end && number >= 1 && number <= names.size()) {
        return number - 1;
    }
    return failure(fmt::format("no stage is called '{}'", *asked),
                   fmt::format("the stages are {}", fmt::join(names, ", ")));
}

/// Marks parameters as varying, so that the kernel takes a plane for each.
Result<void> make_per_cell(Program& program, std::uint32_t k,
                           const std::vector<std::string>& names) {
    const System& system = program.system_of(k);
    std::vector<std::string> known;
    for (std::uint32_t item = 0; item < system.item_count(); ++item) {
        if (!system.is_species(item)) known.emplace_back(system.item_name(item));
    }
    for (const std::string& name : names) {
        bool found = false;
        for (std::uint32_t item = 0; item < system.item_count(); ++item) {
            if (system.item_name(item) != name || system.is_species(item)) continue;
            program.stages[k].uniform[item] = false;
            found = true;
        }
        if (found) continue;
        const std::string near = nearest_name(name, known);
        return failure(fmt::format("--per-cell: '{}' is not a parameter of {}", name, system.name),
                       near.empty() ? "" : fmt::format("did you mean '{}'?", near));
    }
    return {};
}

/// A C identifier of a text: other characters become '_', a leading digit gets one before it.
std::string c_identifier(const std::string& text) {
    std::string name;
    for (const char c : text) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128;
        name += plain ? c : '_';
    }
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) name.insert(0, "_");
    return name;
}

}  // namespace

Result<CompiledStep> compile_step(const Script& script, const CompileRequest& request) {
    Program program = *script.program;
    const auto stage = find_stage(program, request.stage);
    if (!stage) return tl::unexpected(stage.error());
    if (auto good = make_per_cell(program, *stage, request.per_cell); !good) {
        return tl::unexpected(good.error());
    }
    if (const Solver solver = program.stages[*stage].time.solver; solver != Solver::euler) {
        return failure(fmt::format("stage '{}' is solved by {}, but a function computes a step of euler",
                                   program.stages[*stage].name, name_of(solver)),
                       "--solver euler compiles that");
    }
    const StepPlan plan = plan_step(program, *stage);
    if (plan.passes.size() > 1 || plan.aggregates > 0) {
        return failure(fmt::format("a step of stage '{}' takes {} passes over the grid or an aggregate"
                                   " over the domain, but a function computes one pass alone",
                                   program.stages[*stage].name, plan.passes.size()),
                       "--dump plan shows the passes");
    }
    const BoundKernel bound = lower_step(program, *stage);
    const std::string name = c_identifier(
        request.function_name.empty()
            ? std::filesystem::path(script.name).stem().string() + "_" +
                  program.stages[*stage].name
            : request.function_name);
#if CASCADE_HAS_JIT
    if (program.domain.grid.depth > 1) {
        return failure("a grid with slices is not compiled to an object file in this version",
                       "'cascade run' compiles it in memory");
    }
    if (!program.stages[*stage].sides.empty()) {
        return failure(fmt::format("stage '{}' gives its species sides of their own, which object "
                                   "files do not have in this version",
                                   program.stages[*stage].name));
    }
    if (program.domain.mask) {
        return failure("a domain with a mask is not compiled to an object file in this version",
                       "'cascade run' compiles it in memory");
    }
    ObjectOptions options;
    options.function_name = name + "_rows";
    options.target = request.target;
    auto object = compile_object(bound.kernel, program.domain.grid.stencil(), options);
    if (!object) return tl::unexpected(object.error());
    const std::string file = std::filesystem::path(script.name).filename().string();
    return CompiledStep{std::move(*object), c_header(program, *stage, bound, name, file)};
#else
    return failure("this build has no native compiler");
#endif
}

}  // namespace cascade
