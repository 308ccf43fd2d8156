// Strokes on a running cascade: new values of an item of the current stage.
#include "run/session/live_run.h"

#include "run/domain/domain_mask.h"
#include "run/simulation/other_cells.h"
#include "run/simulation/tissue_stage.h"
#include "solvers/finite.h"
#include "tissue/tissue.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

namespace cascade {
namespace {

/// Whether the value of a cell is not finite. Ignores positions of the planes that hold no cell.
bool has_not_finite(const Field& values, const Tissue& tissue) {
    for (std::size_t cell = 0; cell < tissue.count(); ++cell) {
        if (!std::isfinite(value_in(values, tissue, cell))) return true;
    }
    return false;
}

tl::unexpected<Refusal> refuse_not_finite(const std::string& item) {
    return refuse(fmt::format("'{}' would not be finite in every cell", item));
}

tl::unexpected<Refusal> refuse_count(const SetValues& change, std::size_t cells) {
    return refuse(fmt::format("{} values for '{}' do not fit {} cells", change.values.size(),
                              change.item, cells));
}

/// Makes a field from the values of a grid, row by row.
Field field_of_rows(std::span<const double> values, const PlaneLayout& layout,
                    Precision precision) {
    Field field(layout, precision);
    field.visit([&]<typename Number>(Plane<Number>& plane) {
        auto value = values.begin();
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < plane.layout().width; ++i, ++value) {
                plane.row(row)[i] = static_cast<Number>(*value);
            }
        }
    });
    return field;
}

}  // namespace

Accepted<void> LiveRun::make(const Paint& change) {
    return paint(change.item, [&] { return painted_values(change); });
}
Accepted<void> LiveRun::make(const SetValues& change) {
    return paint(change.item, [&] { return painted_values(change); });
}
Accepted<void> LiveRun::paint(const std::string& name, const StrokeValues& values) {
    return state().tissue() != nullptr ? paint_cells(name, values) : paint_fields(name, values);
}

/// Finds the item that a stroke changes. Refuses items that do not vary by cell.
Accepted<ItemId> LiveRun::painted_item(const std::string& name, const char* paintable) const {
    const Program& program = *script_->program;
    const System& system = program.system_of(stage_);
    const Stage& stage = program.stages[stage_];
    const std::optional<ItemId> item = find_item(system, name);
    const bool is_hidden = item && system.cells && system.cells->has_component(*item);
    if (!item || is_hidden || *item == system.speed_item()) {
        return refuse(fmt::format("stage '{}' has nothing called '{}' that can be painted",
                                  stage.name, name),
                      paintable);
    }
    if (!system.is_species(*item) && stage.uniform[*item]) {
        return refuse(fmt::format("'{}' is one number for all cells", name),
                      fmt::format("'{0}: {0} + 0*x' in the stage gives each cell its own value",
                                  name));
    }
    return *item;
}

/// Evaluates the expression of the change, in the cells of the domain or in crawling cells.
Accepted<Field> LiveRun::painted_values(const Paint& change) {
    Diagnostics errors;
    const std::optional<Formula> formula = number("<paint>", change.expression, errors);
    if (formula) return std::move(simulation_->evaluate(*formula, stage_)[0]);
    Refusal refused;
    refused.diagnostics = std::move(errors);
    refused.sources = script_->sources;
    return tl::unexpected(std::move(refused));
}

Accepted<Field> LiveRun::painted_values(const SetValues& change) {
    const std::span<const double> values = change.values;
    if (const Tissue* const tissue = state().tissue()) {
        if (values.size() != tissue->count()) return refuse_count(change, tissue->count());
        Field field(tissue->layout(), simulation_->domain().program->domain.precision);
        field.visit([&]<typename Number>(Plane<Number>& plane) {
            auto value = values.begin();
            for (const std::uint32_t element : tissue->elements_by_number()) {
                plane.origin()[element] = static_cast<Number>(*value++);
            }
        });
        return field;
    }
    const SimulationDomain& domain = simulation_->domain();
    const Precision precision = domain.program->domain.precision;
    if (domain.model) {
        const ModelCells& model = *domain.model->cells;
        if (values.size() != model.count()) return refuse_count(change, model.count());
        return field_of_cells(values, model, precision);
    }
    const PlaneLayout layout(domain.grid);
    const auto cells = static_cast<std::size_t>(layout.width * layout.row_count());
    if (values.size() != cells) return refuse_count(change, cells);
    return field_of_rows(values, layout, precision);
}

void LiveRun::give(const std::string& name, ItemId item, Field values) {
    simulation_->change_stage(stage_, [&](StageState& state) {
        take_values(state, *script_->program, stage_, {&item, 1}, {&values, 1});
    });
    painted_[stage_].insert(name);
}

Accepted<void> LiveRun::paint_fields(const std::string& name, const StrokeValues& values_of) {
    auto item = painted_item(name, "species, parameters and 'frozen' can be painted");
    if (!item) return tl::unexpected(std::move(item.error()));
    auto values = values_of();
    if (!values) return tl::unexpected(std::move(values.error()));
    if (const auto& mask = simulation_->domain().mask) *values = with_outside(*values, *mask, 0);
    if (first_not_finite(*values)) return refuse_not_finite(name);
    give(name, *item, in_cells_of(*simulation_, stage_, *item, std::move(*values)));
    return {};
}

Accepted<void> LiveRun::paint_cells(const std::string& name, const StrokeValues& values_of) {
    const bool removes = name == "remove";
    Accepted<ItemId> item;
    if (!removes) {
        item = painted_item(name,
                            "species, parameters, 'r', 'age' and 'frozen' can be painted; "
                            "'remove' takes cells away");
        if (!item) return tl::unexpected(std::move(item.error()));
    }
    auto values = values_of();
    if (!values) return tl::unexpected(std::move(values.error()));
    if (has_not_finite(*values, *state().tissue())) return refuse_not_finite(name);
    if (!removes) {
        give(name, *item, std::move(*values));
        return {};
    }
    std::size_t left = 0;
    simulation_->change_stage(stage_, [&](StageState& state) {
        left = remove_cells(*state.tissue(), *values);
    });
    if (left == 0) return refuse("this would remove all cells", "at least one cell must stay");
    painted_[stage_].insert(name);
    return {};
}

}  // namespace cascade
