// All planes are divided by core/resample; what is uniform stays.
#include "run/simulation/finer_view.h"

#include "core/resample.h"
#include "run/simulation/regridded_state.h"
#include "run/simulation/stage_view.h"

#include <memory>
#include <utility>

namespace cascade {

namespace {

Field finer_field(const Field& field, const Grid& grid, std::int64_t times) {
    if (field.empty()) return {};
    return field.visit([&](const auto& plane) { return Field(divided(plane, grid, times)); });
}

/// The values of a side, each for `times` cells.
std::shared_ptr<const SideValues> repeated(const SideValues& values, std::int64_t times) {
    SideValues result;
    result.first = values.first * times;
    for (const double number : values.numbers) {
        result.numbers.insert(result.numbers.end(), static_cast<std::size_t>(times), number);
    }
    return std::make_shared<const SideValues>(std::move(result));
}

StageState finer_state(const StageState& state, const Grid& grid, std::int64_t times) {
    StageState result =
        regridded(state,
                  {grid.spacing / static_cast<double>(times),
                   [&](const Field& plane) { return finer_field(plane, grid, times); },
                   [&](const SideValues& values, std::size_t) { return repeated(values, times); }});
    if (!state.frozen.empty()) {
        const Grid finer = finer_grid(grid, times);
        result.frozen = Mask(PlaneLayout(finer));
        for (std::int64_t j = 0; j < finer.height; ++j) {
            for (std::int64_t i = 0; i < finer.width; ++i) {
                result.frozen.row(j)[i] =
                    state.frozen.row(grid.height > 1 ? j / times : j)[i / times];
            }
        }
    }
    return result;
}

}  // namespace

FinerView::FinerView(const Environment& environment, std::span<const StageState> states,
                     std::int64_t times) {
    Environment& here = environment_;
    const Grid& grid = environment.grid;
    here.script = environment.script;
    here.own_program = *environment.program;
    here.own_program->domain.grid = finer_grid(grid, times);
    here.program = &*here.own_program;
    here.grid = here.program->domain.grid;
    here.threads = environment.threads;
    here.plans = std::make_unique<StagePlans>(*here.program, environment.plans->options());
    here.kernels =
        std::make_unique<KernelMaker>(here.grid, environment.kernels->stepper(),
                                      environment.kernels->starts_interpreted(), nullptr);
    here.team = std::make_unique<Team>(environment.team->size());
    here.files = environment.files.mapped(
        [&](const Field& plane) { return finer_field(plane, grid, times); });
    for (const StageState& state : states) states_.push_back(finer_state(state, grid, times));
}

std::vector<Field> FinerView::evaluate(const Formula& formula, std::uint32_t stage) const {
    return StageView(environment_, states_, stage).evaluate(formula);
}

}  // namespace cascade
