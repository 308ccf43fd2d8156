// Prints the checked program for `--dump program`.
#include "lang/print/print_formula.h"
#include "lang/program/cell_items.h"
#include "lang/program/models.h"
#include "lang/program/program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <string>
#include <vector>

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

/// Prints the starting value of an item. If the item belongs to a frame, prints the two axes that
/// determine the frame, because the item's own formulas would fill pages.
std::string print_start(const Program& program, const System& system, ItemId item,
                        const Formula& start, std::optional<std::uint32_t> stage) {
    const bool is_of_axes = is_component_of_frame(system, item) && start.nodes.size() > 1;
    return is_of_axes ? "(of ey and ez)" : print_formula(program, system, start, stage);
}

/// Prints the parts that only blocks of cells have.
void print_rules(const Program& program, const System& system, Output out) {
    const CellRules& rules = *system.cells;
    const auto print = [&](std::string_view name, const Formula& formula, std::string_view end) {
        if (formula.nodes.empty()) return;
        fmt::format_to(out, "  {}: {}{}\n", name, print_formula(program, system, formula), end);
    };
    for (const ItemId item : rules.restarts.ids()) {
        print(system.item_name(item), rules.restarts[item], " after divide");
    }
    print("divide", rules.divide, "");
    print("die", rules.die, "");
    print("along", rules.along, "");
    print("ey", rules.ey, "");
    print("ez", rules.ez, "");
    fmt::format_to(out, "  reach: {}\n", rules.reach);
    for (const Formula& distance : rules.near) print("near", distance, "");
}

void print_system(const Program& program, const System& system, Output out) {
    fmt::format_to(out, "{} {} {{\n", system.cells ? "cells" : "system", system.name);
    print_settings(program, system, out);
    if (system.cells) print_rules(program, system, out);
    for (const ItemId item : system.quantities.ids()) {
        const Quantity& quantity = system.quantities[item];
        fmt::format_to(out, "  {}: {}  # {}\n", quantity.name,
                       print_start(program, system, item, quantity.start, std::nullopt),
                       quantity.is_species ? "species" : "parameter");
    }
    for (const Definition& definition : system.definitions) {
        fmt::format_to(out, "  {} = {}\n", definition.name,
                       print_formula(program, system, definition.formula));
    }
    for (const ItemId item : system.rate_order) {
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

const char* kind_of(const Program& program, std::uint32_t index, ItemId item) {
    if (program.system_of(index).is_species(item)) return "species";
    return program.stages[index].uniform[item] ? "uniform" : "varies";
}

/// Prints the settings of time that differ from their defaults.
void print_time(const Program& program, const System& system, const Stage& stage,
                std::uint32_t index, Output out) {
    const StageTime& time = stage.time;
    if (stage.coarse > 1) fmt::format_to(out, "  grid: coarse({})\n", stage.coarse);
    if (time.coarse > 1) fmt::format_to(out, "  start: coarse({})\n", time.coarse);
    if (time.solver != Solver::euler) fmt::format_to(out, "  solver: {}\n", name_of(time.solver));
    if (time.chooses_steps()) fmt::format_to(out, "  tolerance: {}\n", time.step_tolerance());
    if (time.largest_step) fmt::format_to(out, "  largest_step: {}\n", *time.largest_step);
    if (time.duration) fmt::format_to(out, "  duration: {}\n", *time.duration);
    if (time.duration_in_steps) {
        fmt::format_to(out, "  duration: {} * [speed]\n", *time.duration_in_steps);
    }
    if (time.every > 0) fmt::format_to(out, "  every: {}\n", time.every);
    if (time.automatic_speed) fmt::format_to(out, "  speed: auto\n");
    if (time.steady) fmt::format_to(out, "  until: steady({})\n", *time.steady);
    if (time.until) {
        fmt::format_to(out, "  until: {}\n", print_formula(program, system, *time.until, index));
    }
    if (time.steady || time.until) {
        fmt::format_to(out, "  check: {}\n", time.steps_between_looks());
    }
}

void print_start_of_cells(const Program& program, const System& system, const Stage& stage,
                          std::uint32_t index, Output out) {
    if (stage.founders) {
        const Founders& founders = *stage.founders;
        if (founders.places.empty()) {
            fmt::format_to(out, "  founders: {}", founders.count);
        } else {
            fmt::format_to(out, "  founders: keys({})", fmt::join(founders.places, ", "));
        }
        const std::string chance = print_formula(program, system, founders.chance, index);
        fmt::format_to(out, "{}{}\n", chance.empty() ? "" : ", ", chance);
    }
    const auto print = [&](std::string_view name, const Formula& formula) {
        if (formula.nodes.empty()) return;
        fmt::format_to(out, "  {}: {}\n", name, print_formula(program, system, formula, index));
    };
    print("body", stage.body);
    print("remove", stage.remove);
}

void print_sides(const Program& program, std::uint32_t index, std::string_view name,
                 const SideSettings& sides, Output out) {
    const System& system = program.system_of(index);
    for (std::size_t side = 0; side < wall_count; ++side) {
        const SideSetting& setting = sides[side];
        if (setting.span.end == 0) continue;  // The rule follows from the boundary setting.
        fmt::format_to(out, "  {}.{}: {}", name, side_names[side],
                       side_kind_words[static_cast<std::size_t>(setting.kind)]);
        if (takes_value(setting.kind)) {
            fmt::format_to(out, "({})", print_formula(program, system, setting.value, index));
        }
        fmt::format_to(out, "\n");
    }
}

void print_growth(const Program& program, const Growth& growth, std::uint32_t index, Output out) {
    const System& system = program.system_of(index);
    const auto text = [&](const Formula& formula) {
        return print_formula(program, system, formula, index);
    };
    fmt::format_to(out, "  lengths grow by: {}, {}, {}  # already in the rates\n",
                   text(growth.scale[0]), text(growth.scale[1]), text(growth.scale[2]));
}

void print_stage(const Program& program, std::uint32_t index, Output out) {
    const Stage& stage = program.stages[index];
    const System& system = program.system_of(index);
    fmt::format_to(out, "stage {}: {} {{  # in order of computing\n", stage.name, system.name);
    fmt::format_to(out, "  iterations: {}\n  interval: {}\n", stage.iterations, stage.interval);
    print_time(program, system, stage, index, out);
    if (stage.growth) print_growth(program, *stage.growth, index, out);
    if (stage.size) fmt::format_to(out, "  size: {}\n", stage.size->wanted);
    if (stage.cell_size > 0) fmt::format_to(out, "  size: {}\n", stage.cell_size);
    if (system.cells) print_start_of_cells(program, system, stage, index, out);
    for (const ItemId item : stage.order) {
        fmt::format_to(out, "  {}: {}  # {}\n", system.item_name(item),
                       print_start(program, system, item, stage.items[item], index),
                       kind_of(program, index, item));
    }
    const auto species = system.species();
    for (const SpeciesId id : stage.sides.ids()) {
        print_sides(program, index, system.item_name(species[id]), stage.sides[id], out);
    }
    for (const DefinitionSides& each : stage.definition_sides) {
        print_sides(program, index, system.definitions[each.definition].name, each.sides, out);
    }
    fmt::format_to(out, "  show: {}\n}}\n\n", print_formula(program, system, stage.show, index));
}

const char* word_of(Boundary boundary) {
    return boundary == Boundary::periodic ? "periodic" : "noflux";
}

std::string boundary_words(const Boundaries& boundary) {
    if (boundary == Boundaries(boundary.x)) return word_of(boundary.x);
    return fmt::format("{}, {}, {}", word_of(boundary.x), word_of(boundary.y), word_of(boundary.z));
}

void print_grid(const Program& program, Output out) {
    const Grid& grid = program.domain.grid;
    fmt::format_to(out, "  grid: {}, {}", grid.width, grid.height);
    if (grid.depth > 1) fmt::format_to(out, ", {}", grid.depth);
    if (grid.spacing != 1) fmt::format_to(out, "\n  spacing: {}", grid.spacing);
    fmt::format_to(out, "\n  boundary: {}\n", boundary_words(grid.boundary));
    if (program.domain.stencil != StencilKind::cross) {
        fmt::format_to(out, "  stencil: {}\n",
                       program.domain.stencil == StencilKind::fourth ? "fourth" : "isotropic");
    }
    if (const auto& mask = program.domain.mask) {
        fmt::format_to(out, "  mask: {}\n", print_formula(program, {}, mask->formula));
    }
}

void print_directions(const Program& program, const ModelSettings& model, Output out) {
    const DirectionSettings& directions = *model.directions;
    fmt::format_to(out, "  directions: ");
    using Kind = DirectionSettings::Kind;
    switch (directions.kind) {
        case Kind::axis:
            fmt::format_to(out, "axis({})", fmt::join(directions.numbers, ", "));
            break;
        case Kind::gradient:
            fmt::format_to(out, "gradient({})", print_formula(program, {}, *directions.height));
            break;
        case Kind::curvature_high:
            fmt::format_to(out, "curvature_high({})", directions.smoothing);
            break;
        case Kind::curvature_low:
            fmt::format_to(out, "curvature_low({})", directions.smoothing);
            break;
        case Kind::keys:
            fmt::format_to(out, "keys({}, {})", fmt::join(directions.numbers, ", "),
                           directions.smoothing);
            break;
    }
    fmt::format_to(out, "\n  stretch: {}\n", model.stretch);
}

void print_model(const Program& program, Output out) {
    const ModelSettings& model = *program.domain.model;
    if (model.shape == ModelShape::file) {
        fmt::format_to(out, "  mesh: \"{}\"\n", model.path);
    } else {
        std::vector<std::string> sizes;
        if (model.implicit) sizes.push_back(print_formula(program, {}, *model.implicit));
        for (const double size : model.sizes) sizes.push_back(fmt::format("{}", size));
        const std::string brackets =
            sizes.empty() ? "" : fmt::format("({})", fmt::join(sizes, ", "));
        fmt::format_to(out, "  surface: {}{}\n", word_of(model.shape), brackets);
    }
    switch (model.cells) {
        case ModelCellKind::spread: fmt::format_to(out, "  cells: {}\n", model.count); break;
        case ModelCellKind::faces: fmt::format_to(out, "  cells: faces\n"); break;
        case ModelCellKind::vertices: fmt::format_to(out, "  cells: vertices\n"); break;
    }
    if (model.laplacian == ModelLaplacian::turk) fmt::format_to(out, "  laplacian: turk\n");
    if (model.unit) fmt::format_to(out, "  unit: {}\n", *model.unit);
    if (model.extent) fmt::format_to(out, "  extent: {}\n", *model.extent);
    const Stance& stance = model.stance;
    if (stance.up != Axis::y) fmt::format_to(out, "  up: {}\n", name_of(stance.up));
    if (stance != usual_stance(stance.up)) {
        fmt::format_to(out, "  facing: {}\n", name_of(stance.facing));
    }
    if (model.directions) print_directions(program, model, out);
}

void print_domain(const Program& program, Output out) {
    fmt::format_to(out, "domain {{\n");
    if (program.domain.model) {
        print_model(program, out);
    } else {
        print_grid(program, out);
    }
    fmt::format_to(out, "  seed: {}\n", program.domain.seed);
    if (program.domain.fast) fmt::format_to(out, "  fast\n");
    if (program.domain.precision != Precision::single) {
        fmt::format_to(out, "  precision: {}\n", name_of(program.domain.precision));
    }
    fmt::format_to(out, "}}\n");
}

}  // namespace

std::string print_program(const Program& program) {
    std::string text;
    const Output out = std::back_inserter(text);
    IdVector<SystemId, bool> used(program.systems.size(), program.stages.empty());
    for (const Stage& stage : program.stages) used[stage.system] = true;
    for (const SystemId id : program.systems.ids()) {
        if (used[id]) print_system(program, program.systems[id], out);
    }
    print_domain(program, out);
    for (std::uint32_t i = 0; i < program.stages.size(); ++i) {
        text += "\n";
        print_stage(program, i, out);
        text.pop_back();
    }
    return text;
}

}  // namespace cascade
