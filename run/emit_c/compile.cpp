// Refuses stages that C cannot express, and compiles kernels and data into one object file.
#include "run/emit_c/compile.h"

#include "core/near_name.h"
#include "ir/interpreter.h"
#include "jit/jit.h"
#include "lang/calculus/side_values.h"
#include "lang/lower/lower.h"
#include "run/domain/metric_planes.h"
#include "run/emit_c/c_header.h"
#include "run/emit_c/c_stage.h"
#include "run/simulation/stage_sizes.h"
#include "run/simulation/stage_tools.h"
#include "run/stage/plan_runner.h"
#include "run/stage/stage_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace cascade {

namespace {

/// Whether a formula reads a value that is not in `numbers`.
bool reads_unknown(const Formula& formula, std::uint32_t stage, const KnownNumbers& numbers,
                   const Program& program) {
    return std::any_of(formula.nodes.begin(), formula.nodes.end(), [&](const Node& node) {
        const auto is_unknown = [&](StageItem item) {
            return program.stages[item.stage].uniform[item.item] && !numbers[item.stage][item.item];
        };
        const auto* earlier = node.as<StageItem>();
        if (earlier != nullptr) return is_unknown(*earlier);
        return node.is<ItemId>() && is_unknown({stage, *node.as<ItemId>()});
    });
}

/// Computes the uniform starting values of stages 0 … `last` with the interpreter on a single cell.
/// If a value depends on an unknown value, it is unknown, too.
KnownNumbers known_numbers(const Program& program, std::uint32_t last) {
    KnownNumbers numbers;
    std::vector<StageState> states;
    const InputFiles no_files;
    const auto interpreter = make_interpreter();
    const Grid one{1, 1, Boundary::periodic};
    Team team(1);
    const auto compile = [&](const CellKernel& kernel) {
        return *interpreter->compile(kernel, one.stencil());
    };
    for (std::uint32_t k = 0; k <= last; ++k) {
        const Stage& stage = program.stages[k];
        const StepPlan plan = plan_uniform_start(program, k);
        states.push_back(empty_state(program.system_of(k)));
        const auto values = run_plan(plan, compile, {states, no_files, 0, one}, one, team);
        auto& known = numbers.emplace_back(stage.items.size());
        IdVector<ItemId, std::optional<float>> computed(stage.items.size());
        for (std::size_t r = 0; r < values.size(); ++r) {
            computed[plan.results[r]] = values[r].at(0, 0);
            states[k].numbers[plan.results[r]] = values[r].at(0, 0);
        }
        // The items are in the order of evaluation, so an item comes after its operands.
        for (const ItemId item : stage.order) {
            if (!reads_unknown(stage.items[item], k, numbers, program))
                known[item] = computed[item];
        }
    }
    return numbers;
}

/// Marks parameters as varying by cell, so that kernels read a plane for each of them.
Result<void> make_per_cell(Program& program, std::uint32_t k,
                           const std::vector<std::string>& names) {
    const System& system = program.system_of(k);
    std::vector<std::string> known;
    for (const ItemId item : system.items()) {
        if (!system.is_species(item)) known.emplace_back(system.item_name(item));
    }
    for (const std::string& name : names) {
        bool found = false;
        for (const ItemId item : system.items()) {
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

/// Turns a text into a C identifier. Invalid characters become '_'. If the text is empty or begins
/// with a digit, '_' is added before it.
std::string c_identifier(const std::string& text) {
    std::string name;
    for (const char c : text) {
        const auto letter = static_cast<unsigned char>(c);
        name += letter < 128 && std::isalnum(letter) != 0 ? c : '_';
    }
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) name.insert(0, "_");
    return name;
}

/// Returns the scheme of a step. Fails if steps have no fixed length. If `asked_solver` is true,
/// the option --solver has chosen the solver, which may be the only reason for the failure, and the
/// error then says so. `parts` is the number of parts into which a step of Euler's method is
/// divided.
Result<Scheme> fixed_scheme(const Program& program, std::uint32_t k,
                            std::optional<std::uint32_t> stages, std::uint32_t parts,
                            bool asked_solver) {
    const Stage& stage = program.stages[k];
    const std::string name(name_of(stage.time.solver));
    if (is_adaptive(stage.time.solver)) {
        return failure(
            fmt::format("stage '{}' is solved by {}, which chooses its steps during the run, but "
                        "all compiled steps have the same length",
                        stage.name, name),
            "use --solver rk4");
    }
    if (is_semi_implicit(stage.time.solver)) {
        return failure(
            fmt::format("stage '{}' is solved by {}, which computes all cells of the grid "
                        "together and cannot be compiled",
                        stage.name, name),
            "use --solver rkl1 --stages 7 for long steps");
    }
    if (stage.time.automatic_speed) {
        return failure(
            fmt::format("stage '{}' chooses its steps during the run, but all compiled steps "
                        "have the same length",
                        stage.name),
            asked_solver
                ? fmt::format("use --set {}.solver={}, which keeps the speed", stage.name, name)
                : fmt::format("use --set {}.speed=… for this length", stage.name));
    }
    if (stage.time.every > 0) {
        return failure(fmt::format("steps of stage '{}' end at multiples of 'every', but all "
                                   "compiled steps have the same length",
                                   stage.name),
                       "write 'interval', which counts steps");
    }
    if (is_stabilised(stage.time.solver) && !stages) {
        return failure(fmt::format("stage '{}' is solved by {}, which chooses the number of its "
                                   "stages as it runs, but a compiled step has a fixed number",
                                   stage.name, name),
                       "use --stages N with an odd number");
    }
    if (stages && !is_stabilised(stage.time.solver)) {
        return failure(fmt::format(
            "--stages: {} has no stages to choose; only rkl1 and rkl2 have stages", name));
    }
    const ItemId speed = program.system_of(k).speed_item();
    if (!stage.uniform[speed] && !takes_speed_by_cell(stage.time.solver)) {
        return failure(fmt::format("{} cannot take the speed of stage '{}', which varies by cell",
                                   name, stage.name));
    }
    if (parts > 1) {
        return StageTimer::split_scheme(program.system_of(k).species_count(), parts);
    }
    return make_scheme(stage.time.solver, program.system_of(k).species_count(),
                       takes_speed_by_cell(stage.time.solver), stages.value_or(3));
}

/// The program after the sizes of its stages have been found and applied.
struct SizedStages {
    Program program;
    /// The number of parts into which a step of the stage is divided. 0 and 1 mean that steps are
    /// not divided.
    std::uint32_t parts = 0;
};

Result<SizedStages> with_sizes(Script& script, const std::string& asked,
                               const std::filesystem::path& kernel_cache) {
    SizedStages result{*script.program};
    if (!has_sizes(script)) return result;
    const auto stage = find_stage(result.program, asked);
    if (!stage) return tl::unexpected(stage.error());
    SimulationOptions options;
    options.kernel_cache = kernel_cache;
    const auto made = Simulation::create(script, options);
    if (!made) return tl::unexpected(made.error());
    Simulation& simulation = **made;
    result.program = *simulation.domain().program;
    for (std::uint32_t k = 0; k <= *stage; ++k) {
        if (auto started = simulation.start_stage(k); !started)
            return tl::unexpected(started.error());
    }
    (void)step_work(simulation, *stage);  // This call initialises the time of the stage.
    if (result.program.stages[*stage].time.solver == Solver::euler)
        result.parts = simulation.state(*stage).time.stages;
    return result;
}

/// Fails if a header cannot express the domain or the stage.
Result<void> check_header_knows(const Program& program, std::uint32_t stage) {
    if (program.domain.model) {
        return failure("a stage on a model cannot be compiled to an object file",
                       "use 'cascade run', or --grid for a plane as the domain");
    }
    if (program.domain.precision != Precision::single) {
        return failure("a stage in double precision cannot be compiled to an object file",
                       "use 'cascade run', or --precision single");
    }
    const StepPlan rates = plan_rates(program, stage, {});
    for (const Pass& pass : rates.passes) {
        if (pass.convolutions.empty() && pass.solves.empty()) continue;
        return failure(fmt::format("stage '{}' has a {}, which cannot be compiled to an object "
                                   "file",
                                   program.stages[stage].name,
                                   pass.solves.empty() ? "convolution" : "constraint"),
                       "use 'cascade run' instead");
    }
    for (const auto& sides : program.stages[stage].sides) {
        for (std::size_t side = 0; side < side_count; ++side) {
            if (!takes_value(sides[side].kind)) continue;
            if (!plan_side(program, sides[side], static_cast<Side>(side), stage).changes) continue;
            return failure(
                fmt::format("stage '{}' has a side whose value changes while it runs, which "
                            "cannot be compiled to an object file",
                            program.stages[stage].name),
                "use 'cascade run' instead");
        }
    }
    if (!program.stages[stage].definition_sides.empty()) {
        return failure(
            fmt::format("stage '{}' has a side of a definition, which cannot be compiled to an "
                        "object file",
                        program.stages[stage].name),
            "use 'cascade run' instead");
    }
    if (program.stages[stage].coarse > 1) {
        return failure(fmt::format("stage '{}' runs on a coarser grid, which cannot be compiled "
                                   "to an object file",
                                   program.stages[stage].name),
                       "use 'cascade run' instead");
    }
    if (program.domain.mask) {
        return failure("a domain with a mask cannot be compiled to an object file",
                       "use 'cascade run' instead");
    }
    return {};
}

}  // namespace

Result<CompiledStep> compile_step(Script& script, const CompileRequest& request) {
    if (script.program->stages.empty()) return failure("this script has no stage to compile");
    if (auto good = check_for_fields(script, "C can be written only for"); !good) {
        return tl::unexpected(good.error());
    }
    auto sized = with_sizes(script, request.stage.value_or("1"), request.kernel_cache);
    if (!sized) return tl::unexpected(sized.error());
    Program& program = sized->program;
    if (!request.target.empty()) program.domain.fast = script.overrides.fast;
    const auto stage = find_stage(program, request.stage.value_or("1"));
    if (!stage) return tl::unexpected(stage.error());
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        program.stages[k].sides = side_settings(program, k);
    }
    if (auto fits = check_header_knows(program, *stage); !fits) return tl::unexpected(fits.error());
    const auto numbers = known_numbers(program, *stage);
    if (auto good = make_per_cell(program, *stage, request.per_cell); !good) {
        return tl::unexpected(good.error());
    }
    const auto scheme = fixed_scheme(program, *stage, request.stages, sized->parts,
                                     script.overrides.solver.has_value());
    if (!scheme) return tl::unexpected(scheme.error());
    const auto files = read_input_files(script, nullptr);
    if (!files) return tl::unexpected(files.error());
    const auto metric = metric_planes(program);
    if (!metric) return tl::unexpected(metric.error());
    const std::string name = c_identifier(
        request.function_name.empty() ? output_stem(script) + "_" + program.stages[*stage].name
                                      : request.function_name);
    auto compiled = describe_c_stage({program, *stage, numbers, *files, *metric, *scheme, name});
    if (!compiled) return tl::unexpected(compiled.error());
    ObjectContent content;
    for (const CKernel& each : compiled->kernels)
        content.functions.push_back({each.name, each.kernel});
    for (CData& each : compiled->data)
        content.numbers.push_back({each.name, std::move(each.values)});
    auto object = compile_object(content, program.domain.grid.stencil(), request.target);
    if (!object) return tl::unexpected(object.error());
    const std::string file = script.file.filename().string();
    return CompiledStep{std::move(*object), c_header(program, *stage, *compiled, file)};
}

}  // namespace cascade
