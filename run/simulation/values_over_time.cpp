// Runs the plan of a formula again and again, with another `t` each time.
#include "run/simulation/values_over_time.h"

#include "core/counted_cells.h"
#include "run/stage/plan_runner.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace cascade {

namespace {

constexpr std::int64_t fewest_moments = 16;
/// What is evaluated for all moments takes a fraction of a second.
constexpr std::int64_t most_cells_of_moments = std::int64_t{1} << 23;

/// Of |a − b| over the cells; what is not finite counts as 0.
double sum_of_changes(const Field& a, const Field& b, const Mask* counted) {
    double sum = 0;
    with_number(a.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const auto &before = a.plane<Number>(), &after = b.plane<Number>();
        for_each_counted(before.layout(), counted, [&](std::int64_t row, std::int64_t i) {
            const double change = std::abs(double{after.row(row)[i]} - before.row(row)[i]);
            if (std::isfinite(change)) sum += change;
        });
    });
    return sum;
}

/// Of |a − mean| over the cells.
double sum_of_differences(const Field& a, const Mask* counted) {
    double sum = 0, cells = 0, differences = 0;
    a.visit([&](const auto& plane) {
        const auto for_each = [&](auto use) {
            for_each_counted(plane.layout(), counted, [&](std::int64_t row, std::int64_t i) {
                if (const double value = plane.row(row)[i]; std::isfinite(value)) use(value);
            });
        };
        for_each([&](double value) {
            sum += value;
            ++cells;
        });
        const double mean = cells > 0 ? sum / cells : 0;
        for_each([&](double value) { differences += std::abs(value - mean); });
    });
    return differences;
}

}  // namespace

ValueAt values_at(const StageView& view, const Formula& formula) {
    const Grid one{1, 1, Boundary::periodic};
    const auto runner =
        std::make_shared<PlanRunner>(plan_view(view.program(), formula, view.number()),
                                     view.environment().kernels->interpreted_on(one));
    const auto alone = std::make_shared<Team>(1);
    return [view, runner, alone, one](double t) -> double {
        BindingContext context = view.context();
        context.grid = one;
        context.t = t;
        return runner->run(context, *alone)[0].number_at(0, 0);
    };
}

std::vector<double> motion_over(const StageView& view, const Formula& formula, double duration) {
    const Environment& here = view.environment();
    const Formula* const formulas[] = {&formula};
    if (here.surface_values) here.surface_values->prepare(formulas);
    PlanRunner runner(plan_view(view.program(), formula, view.number()), here.kernels->once());
    const auto at = [&](double t) {
        BindingContext context = view.context();
        context.t = t;
        return runner.run(context, *here.team)[0].clone();
    };
    constexpr auto most_moments = static_cast<std::int64_t>(Forcing::intervals_of_motion);
    const std::int64_t moments =
        std::clamp(most_cells_of_moments / here.grid.cell_count(), fewest_moments, most_moments);
    const double apart = duration / static_cast<double>(most_moments);
    std::vector<double> changes;
    double largest = 0;
    Field next;
    for (std::int64_t m = 0; m < moments; ++m) {
        const double t = duration * static_cast<double>(m) / static_cast<double>(moments);
        Field now = moments == most_moments && m > 0 ? std::move(next) : at(t);
        next = at(t + apart);
        changes.push_back(sum_of_changes(now, next, here.counted()));
        largest = std::max(largest, sum_of_differences(now, here.counted()));
    }
    for (double& change : changes) change = largest > 0 ? change / largest : 0;
    return changes;
}

}  // namespace cascade
