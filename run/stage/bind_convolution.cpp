// Evaluates the kernel of a convolution with the interpreter, on a line of cells with one cell for
// each lag.
#include "run/stage/bind_convolution.h"

#include "core/enough_memory.h"
#include "core/parallel.h"
#include "ir/interpreter.h"
#include "run/domain/file_places.h"
#include "run/stage/plan_runner.h"

#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace cascade {
namespace {

/// Evaluates a plan with a single result on a line of cells.
std::vector<double> values_on_line(const StepPlan& plan, const BindingContext& context,
                                   std::int64_t cells) {
    const std::unique_ptr<Backend> interpreter = make_interpreter();
    const Grid line{cells, 1};
    const Compile compile = [&](const CellKernel& kernel) {
        return *interpreter->compile(kernel, line.stencil());
    };
    Team team(1);
    const Field values = std::move(run_plan(plan, compile, context, line, team).front());
    return values.visit([&](const auto& plane) {
        return std::vector<double>(plane.origin(), plane.origin() + cells);
    });
}

std::array<Field, lag_part_count> parts_of(const std::vector<Lag>& lags, double spacing,
                                           Precision precision) {
    const PlaneLayout layout(Grid{static_cast<std::int64_t>(lags.size()), 1});
    std::array<Field, lag_part_count> parts;
    for (Field& part : parts) part = Field(layout, precision);
    with_number(precision, [&](auto zero) {
        using Number = decltype(zero);
        for (std::size_t n = 0; n < lags.size(); ++n) {
            const auto x = static_cast<double>(lags[n].x), y = static_cast<double>(lags[n].y),
                       z = static_cast<double>(lags[n].z);
            const double length = std::sqrt(x * x + y * y + z * z);
            const double each = length > 0 ? 1 / length : 0;
            const std::array values{length * spacing, x * each, y * each, z * each};
            for (std::size_t k = 0; k < values.size(); ++k) {
                parts[k].template origin<Number>()[n] = static_cast<Number>(values[k]);
            }
        }
    });
    return parts;
}

/// Reads the values of files that a plan on the line of lags needs.
InputFiles files_at_lags(const StepPlan& plan, const BindingContext& context, std::int64_t lags) {
    InputFiles files;
    for (const Pass& pass : plan.passes) {
        for (const PlaneSource& source : pass.bound.fields) {
            const auto* const name = std::get_if<NamedPlane>(&source);
            if (name == nullptr) continue;
            const KernelFile& file = context.files.kernel(*name);
            const auto part = [&](LagPart each, std::int64_t n) {
                return context.lags[static_cast<std::size_t>(each)].number_at(n, 0);
            };
            std::vector<double> values;
            for (std::int64_t n = 0; n < lags; ++n) {
                values.push_back(
                    file.at(part(LagPart::distance, n),
                            {part(LagPart::direction_x, n), part(LagPart::direction_y, n),
                             part(LagPart::direction_z, n)}));
            }
            files.add(*name, plane_of(values, Grid{lags, 1}, nullptr, context.precision));
        }
    }
    return files;
}

}  // namespace

WeightedLags weights_of(const Convolution& convolution, const BindingContext& context) {
    const Grid& grid = context.grid;
    std::optional<double> reach;
    if (convolution.reach) {
        const double value = values_on_line(*convolution.reach, context, 1).front();
        reach = value > 0 ? value : 0;
    }
    auto lags = lags_within(grid, reach);
    if (!lags) lack_memory();  // A stage with too many lags was refused at its start.
    const auto parts = parts_of(*lags, grid.spacing, context.precision);
    const auto count = static_cast<std::int64_t>(lags->size());
    BindingContext at_lags = context;
    at_lags.lags = parts;
    const InputFiles files = files_at_lags(*convolution.weight, at_lags, count);
    BindingContext here{context.states, files, context.steps, grid, context.precision, context.t};
    here.lags = parts;
    WeightedLags weighted;
    weighted.weights = values_on_line(*convolution.weight, here, count);
    const Stencil stencil = grid.stencil();
    const double content = std::pow(grid.spacing, stencil.axes());
    for (double& weight : weighted.weights) weight *= content;
    weighted.lags = std::move(*lags);
    return weighted;
}

}  // namespace cascade
