// `--dump program`: what the checker has made of a script.
#include "lang/print_formula.h"
#include "lang/program.h"

#include <fmt/format.h>

#include <iterator>

namespace cascade {

namespace {

using Output = std::back_insert_iterator<std::string>;

void print_settings(const Program& program, const System& system, Output out) {
    const Settings& settings = system.settings;
    if (settings.iterations) fmt::format_to(out, "  iterations: {}\n", *settings.iterations);
    if (settings.interval) fmt::format_to(out, "  interval: {}\n", *settings.interval);
    const auto print = [&](const char* name, const std::optional<Formula>& formula) {
        if (!formula) return;
        fmt::format_to(out, "  {}: {}\n", name, print_formula(program, system, *formula));
    };
    print("frozen", settings.frozen);
    print("speed", settings.speed);
    print("show", settings.show);
}

void print_system(const Program& program, const System& system, Output out) {
    fmt::format_to(out, "system {} {{\n", system.name);
    print_settings(program, system, out);
    for (const Quantity& quantity : system.quantities) {
        fmt::format_to(out, "  {}: {}  # {}\n", quantity.name,
                       print_formula(program, system, quantity.start),
                       quantity.is_species ? "species" : "parameter");
    }
    for (const Definition& definition : system.definitions) {
        fmt::format_to(out, "  {} = {}\n", definition.name,
                       print_formula(program, system, definition.formula));
    }
    for (const std::uint32_t item : system.rate_order) {
        fmt::format_to(out, "  {}' = {}\n", system.quantities[item].name,
                       print_formula(program, system, system.rates[item]));
    }
    for (const Invariant& invariant : system.invariants) {
        fmt::format_to(out, "  {} {} {}\n", system.quantities[invariant.species].name,
                       invariant.at_least ? ">=" : "<=",
                       print_formula(program, system, invariant.bound));
    }
    fmt::format_to(out, "}}\n\n");
}

const char* kind_of(const Program& program, std::uint32_t index, std::uint32_t item) {
    if (program.system_of(index).is_species(item)) return "species";
    return program.stages[index].uniform[item] ? "uniform" : "varies";
}

/// What is not as it is by default.
void print_time(const Program& program, const System& system, const Stage& stage,
                std::uint32_t index, Output out) {
    const StageTime& time = stage.time;
    if (time.coarse > 1) fmt::format_to(out, "  start: coarse({})\n", time.coarse);
    if (time.solver != Solver::euler) fmt::format_to(out, "  solver: {}\n", name_of(time.solver));
    if (is_adaptive(time.solver)) fmt::format_to(out, "  tolerance: {}\n", time.tolerance);
    if (time.duration) fmt::format_to(out, "  duration: {}\n", *time.duration);
    if (time.duration_in_steps) {
        fmt::format_to(out, "  duration: {} * [speed]\n", *time.duration_in_steps);
    }
    if (time.automatic_speed) fmt::format_to(out, "  speed: auto\n");
    if (time.steady) fmt::format_to(out, "  until: steady({})\n", *time.steady);
    if (time.until) {
        fmt::format_to(out, "  until: {}\n", print_formula(program, system, *time.until, index));
    }
    if (time.steady || time.until) {
        fmt::format_to(out, "  check: {}\n", time.steps_between_looks());
    }
}

void print_sides(const Program& program, std::uint32_t index, std::uint32_t item,
                 const std::array<SideSetting, side_count>& sides, Output out) {
    const System& system = program.system_of(index);
    for (std::size_t side = 0; side < side_count; ++side) {
        const SideSetting& setting = sides[side];
        if (setting.span.end == 0) continue;  // As the boundary says.
        fmt::format_to(out, "  {}.{}: {}", system.item_name(item), side_names[side],
                       side_kind_words[static_cast<std::size_t>(setting.kind)]);
        if (takes_value(setting.kind)) {
            fmt::format_to(out, "({})", print_formula(program, system, setting.value, index));
        }
        fmt::format_to(out, "\n");
    }
}

void print_stage(const Program& program, std::uint32_t index, Output out) {
    const Stage& stage = program.stages[index];
    const System& system = program.system_of(index);
    fmt::format_to(out, "stage {}: {} {{  # in order of computing\n", stage.name, system.name);
    fmt::format_to(out, "  iterations: {}\n  interval: {}\n", stage.iterations, stage.interval);
    print_time(program, system, stage, index, out);
    for (const std::uint32_t item : stage.order) {
        fmt::format_to(out, "  {}: {}  # {}\n", system.item_name(item),
                       print_formula(program, system, stage.items[item], index),
                       kind_of(program, index, item));
    }
    std::size_t species = 0;
    for (std::uint32_t item = 0; item < system.quantities.size() && !stage.sides.empty(); ++item) {
        if (system.is_species(item)) print_sides(program, index, item, stage.sides[species++], out);
    }
    fmt::format_to(out, "  show: {}\n}}\n\n", print_formula(program, system, stage.show, index));
}

const char* word_of(Boundary boundary) {
    return boundary == Boundary::periodic ? "periodic" : "noflux";
}

std::string boundary_words(const Boundaries& boundary) {
    if (boundary == Boundaries(boundary.x)) return word_of(boundary.x);
    return fmt::format("{}, {}, {}", word_of(boundary.x), word_of(boundary.y),
                       word_of(boundary.z));
}

}  // namespace

std::string print_program(const Program& program) {
    std::string text;
    const Output out = std::back_inserter(text);
    std::vector<bool> used(program.systems.size(), program.stages.empty());
    for (const Stage& stage : program.stages) used[stage.system] = true;
    for (std::size_t i = 0; i < program.systems.size(); ++i) {
        if (used[i]) print_system(program, program.systems[i], out);
    }
    const Grid& grid = program.domain.grid;
    fmt::format_to(out, "domain {{\n  grid: {}, {}", grid.width, grid.height);
    if (grid.depth > 1) fmt::format_to(out, ", {}", grid.depth);
    if (grid.spacing != 1) fmt::format_to(out, "\n  spacing: {}", grid.spacing);
    fmt::format_to(out, "\n  boundary: {}", boundary_words(grid.boundary));
    if (const auto& mask = program.domain.mask) {
        fmt::format_to(out, "\n  mask: {}", print_formula(program, {}, mask->formula));
    }
    fmt::format_to(out, "\n  seed: {}\n", program.domain.seed);
    if (program.domain.precision != Precision::single) {
        fmt::format_to(out, "  precision: {}\n", name_of(program.domain.precision));
    }
    fmt::format_to(out, "}}\n");
    for (std::uint32_t i = 0; i < program.stages.size(); ++i) {
        text += "\n";
        print_stage(program, i, out);
        text.pop_back();
    }
    return text;
}

}  // namespace cascade
