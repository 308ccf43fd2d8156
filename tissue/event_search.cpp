// Bisection over the cubic between the ends of a step.
#include "tissue/event_search.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cascade {
namespace {

constexpr int halvings = 20;

/// The cubic through the ends of a step.
class Cubic {
public:
    Cubic(const StepEnds& ends, std::vector<Field> old_rates, std::vector<Field> new_rates)
        : ends_(ends), old_rates_(std::move(old_rates)), new_rates_(std::move(new_rates)) {
        for (const Field& field : ends.old_state) middle_.push_back(field.clone());
    }

    /// The state at a part of the step.
    std::vector<Field>& at(double part) {
        const double rest = 1 - part, h = ends_.moment.length;
        const double of_old = (1 + 2 * part) * rest * rest, of_new = part * part * (3 - 2 * part);
        const double of_old_rate = h * part * rest * rest, of_new_rate = -h * part * part * rest;
        for (std::size_t k = 0; k < middle_.size(); ++k) {
            middle_[k].visit([&]<typename Number>(Plane<Number>& plane) {
                const PlaneLayout& layout = plane.layout();
                for (std::int64_t row = 0; row < layout.row_count(); ++row) {
                    const Number* const y0 = ends_.old_state[k].template row<Number>(row);
                    const Number* const y1 = ends_.new_state[k].template row<Number>(row);
                    const Number* const f0 = old_rates_[k].template row<Number>(row);
                    const Number* const f1 = new_rates_[k].template row<Number>(row);
                    Number* const y = plane.row(row);
                    for (std::int64_t i = 0; i < layout.width; ++i) {
                        y[i] = static_cast<Number>(of_old * y0[i] + of_new * y1[i] +
                                                   (of_old_rate * f0[i] + of_new_rate * f1[i]));
                    }
                }
            });
        }
        return middle_;
    }

private:
    const StepEnds& ends_;
    std::vector<Field> old_rates_, new_rates_, middle_;
};

std::vector<Field> copies_of(const std::vector<Field>& fields) {
    std::vector<Field> copies;
    for (const Field& field : fields) copies.push_back(field.clone());
    return copies;
}

/// The cells of both lists, in ascending order.
std::vector<std::uint32_t> united(const std::vector<std::uint32_t>& a,
                                  const std::vector<std::uint32_t>& b) {
    std::vector<std::uint32_t> all;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
    return all;
}

}  // namespace

CellEvents events_at(const TissueRules::Conditions& conditions, std::vector<Field>& state,
                     const Tissue& tissue, const StepMoment& moment, ValueRunner& runner) {
    CellEvents events;
    if (conditions.values.problem == nullptr) return events;
    const std::vector<Field>& values =
        runner.run(conditions.values, state, static_cast<std::int64_t>(tissue.count()), moment);
    const auto holds = [&](std::optional<std::size_t> plane, std::uint32_t cell) {
        return plane && values[*plane].visit([&](const auto& of_cells) {
            return of_cells.origin()[tissue.element(cell)] > 0;
        });
    };
    for (std::uint32_t cell = 0; cell < tissue.count(); ++cell) {
        if (holds(conditions.die, cell)) {
            events.dying.push_back(cell);
        } else if (holds(conditions.divide, cell)) {
            events.dividing.push_back(cell);
        }
    }
    return events;
}

Result<std::optional<FirstEvents>> first_events(TissueRules& rules, const StepEnds& ends,
                                                double window, const Tissue& tissue,
                                                ValueRunner& runner) {
    const TissueRules::Conditions conditions = rules.conditions();
    const auto moment_at = [&](double part) {
        StepMoment moment = ends.moment;
        moment.t += part * moment.length;
        return moment;
    };
    const auto cells = static_cast<std::int64_t>(tissue.count());
    const auto rates_at = [&](std::vector<Field>& state, double part) {
        return copies_of(runner.run(rules.rates(), state, cells, moment_at(part)));
    };
    if (const auto reached = ends.reach(ends.new_state); !reached) {
        return tl::unexpected(reached.error());
    }
    const CellEvents at_end = events_at(conditions, ends.new_state, tissue, moment_at(1), runner);
    if (at_end.empty()) return std::nullopt;
    std::vector<Field> new_rates = rates_at(ends.new_state, 1);
    if (const auto reached = ends.reach(ends.old_state); !reached) {
        return tl::unexpected(reached.error());
    }
    Cubic cubic(ends, rates_at(ends.old_state, 0), std::move(new_rates));
    const auto events_of = [&](double part) -> Result<CellEvents> {
        std::vector<Field>& state = cubic.at(part);
        const auto reached = ends.reach(state);
        if (!reached) return tl::unexpected(reached.error());
        return events_at(conditions, state, tissue, moment_at(part), runner);
    };
    FirstEvents first{1, at_end};
    double before = 0;
    for (int k = 0; k < halvings; ++k) {
        const double part = (before + first.part) / 2;
        Result<CellEvents> events = events_of(part);
        if (!events) return tl::unexpected(events.error());
        if (events->empty()) {
            before = part;
        } else {
            first = {part, std::move(*events)};
        }
    }
    if (window == 0 || first.part == 1) return first;
    const double part = first.part + window;
    const Result<CellEvents> soon = part < 1 ? events_of(part) : at_end;
    if (!soon) return tl::unexpected(soon.error());
    first.events.dying = united(first.events.dying, soon->dying);
    const std::vector<std::uint32_t> dividing = united(first.events.dividing, soon->dividing);
    first.events.dividing.clear();
    std::set_difference(dividing.begin(), dividing.end(), first.events.dying.begin(),
                        first.events.dying.end(), std::back_inserter(first.events.dividing));
    return first;
}

}  // namespace cascade
