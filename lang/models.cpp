#include "lang/models.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

// Long enough that the padding of rows is small beside them, short enough that threads share them evenly.
constexpr std::int64_t cells_of_row = 512;

/// Why an operator is refused on a model; "" for those that have a meaning.
std::string_view reason_against(Function function) {
    switch (function) {
        case Function::dxx:
        case Function::dyy:
        case Function::dzz:
        case Function::dxy:
        case Function::dxz:
        case Function::dyz: return "a model has no second derivatives by name; lap(e) has a meaning there";
        case Function::advect:
            return "a flow on a model has no columns and rows to go along; "
                   "vx * dx(e) + vy * dy(e) + vz * dz(e) is carried by central differences";
        case Function::diffuse:
        case Function::tensor:
            return "an angle has no meaning on a model, which has no columns and rows";
        case Function::vector:
            return "a flux on a model is made of gradients, as in div(a * grad(e))";
        case Function::field:
        case Function::image:
            return "rows and columns of a file have no meaning on a model";
        default: return "";
    }
}

class ModelProgramChecker {
public:
    ModelProgramChecker(Program& program, Diagnostics& diagnostics)
        : program_(program), diagnostics_(diagnostics) {}

    void check() {
        for (Stage& stage : program_.stages) {
            check_system(program_.systems[stage.system]);
            for (const Formula& formula : stage.items) check_formula(formula);
            check_formula(stage.show);
            if (stage.time.until) check_formula(*stage.time.until);
            check_time(stage);
            leave_sides(stage);
        }
    }

private:
    void check_formula(const Formula& formula) { (void)has_meaning_on_model(formula, diagnostics_); }

    void check_system(const System& system) {
        for (const Formula& rate : system.rates) check_formula(rate);
        for (const Definition& definition : system.definitions) check_formula(definition.formula);
    }

    void check_time(const Stage& stage) {
        if (is_semi_implicit(stage.time.solver)) {
            diagnostics_.error(stage.time.solver_span.end > 0 ? stage.time.solver_span : stage.span,
                               fmt::format("stage '{}': the solver {} needs the waves of a grid, which "
                                           "a model does not have", stage.name, name_of(stage.time.solver)),
                               "rkl1 takes long steps on models");
        }
        if (stage.time.coarse > 1) {
            diagnostics_.error(stage.time.coarse_span,
                               fmt::format("stage '{}' starts on a coarser grid, which a model does "
                                           "not have", stage.name));
        }
    }

    /// Boundaries of a model have no flux through them.
    void leave_sides(Stage& stage) {
        for (const auto& sides : stage.sides) {
            for (const SideSetting& side : sides) {
                if (!takes_value(side.kind)) continue;
                diagnostics_.warning(side.span, "a model has no sides: this is left aside");
            }
        }
        stage.sides.clear();
    }

    Program& program_;
    Diagnostics& diagnostics_;
};

}  // namespace

Grid rows_of_cells(std::int64_t cells) {
    Grid grid;
    grid.width = std::min(std::max<std::int64_t>(cells, 1), cells_of_row);
    grid.height = (std::max<std::int64_t>(cells, 1) + grid.width - 1) / grid.width;
    grid.boundary = Boundary::no_flux;
    grid.linked = true;
    return grid;
}

void set_model(Program& program, ModelSettings model) {
    DomainSettings& domain = program.domain;
    domain.grid = rows_of_cells(model.count);
    domain.grid_span = model.cells_span;
    domain.mask.reset();
    domain.surface.reset();
    domain.sides = {};
    domain.model = std::move(model);
}

std::optional<ModelShape> shape_named(std::string_view word) {
    if (word == "sphere") return ModelShape::sphere;
    if (word == "torus") return ModelShape::torus;
    if (word == "box") return ModelShape::box;
    if (word == "creature") return ModelShape::creature;
    return std::nullopt;
}

bool has_meaning_on_model(const Formula& formula, Diagnostics& diagnostics) {
    bool has_meaning = true;
    for (const Node& node : formula.nodes) {
        if (node.kind != NodeKind::call) continue;
        const std::string_view reason = reason_against(node.function);
        if (reason.empty()) continue;
        has_meaning = false;
        diagnostics.error(node.span,
                          fmt::format("{} cannot be used on a model", info(node.function).spelling),
                          std::string(reason));
    }
    return has_meaning;
}

void check_on_model(Program& program, Diagnostics& diagnostics) {
    ModelProgramChecker(program, diagnostics).check();
}

}  // namespace cascade
