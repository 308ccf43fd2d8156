// Looks for the first root among the margins of all cells on the cubic between the ends of a step.
#include "tissue/event_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

namespace cascade {
namespace {

/// The part of a step to which moments are found: 2 to this power. In single precision species
/// change by less than their rounding in shorter ones.
int power_of(Precision precision) { return precision == Precision::single ? -16 : -20; }
/// Conditions without slopes take a few probes more than bisection, smooth ones a fifth of them.
constexpr int more_than_bisection = 4;

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

/// The values of a condition by cell; empty if there is none.
using Margins = std::vector<double>;

/// The conditions at a part of the step.
struct Probe {
    double part = 0;
    std::array<Margins, 2> margins;  ///< Of dying and of dividing.

    CellEvents events() const {
        CellEvents result;
        const auto& [dying, dividing] = margins;
        for (std::uint32_t cell = 0; cell < std::max(dying.size(), dividing.size()); ++cell) {
            if (!dying.empty() && dying[cell] > 0) {
                result.dying.push_back(cell);
            } else if (!dividing.empty() && dividing[cell] > 0) {
                result.dividing.push_back(cell);
            }
        }
        return result;
    }
};

Probe probe(const TissueRules::Conditions& conditions, std::vector<Field>& state,
            const Tissue& tissue, const StepMoment& moment, ValueRunner& runner) {
    Probe result;
    if (conditions.values.problem == nullptr) return result;
    const std::vector<Field>& values =
        runner.run(conditions.values, state, static_cast<std::int64_t>(tissue.count()), moment);
    const std::array planes{conditions.die, conditions.divide};
    for (std::size_t k = 0; k < planes.size(); ++k) {
        if (!planes[k]) continue;
        Margins& margins = result.margins[k];
        margins.resize(tissue.count());
        values[*planes[k]].visit([&](const auto& plane) {
            tissue.each_cell([&](std::size_t cell, std::int64_t at) {
                margins[cell] = static_cast<double>(plane.origin()[at]);
            });
        });
    }
    return result;
}

/// The root between 0 and `width` of the parabola with the value `first` <= 0 at 0, `last` > 0 at
/// `width` and `other` at `elsewhere`, or of the straight line if there is no third point.
double root_of(double first, double last, double width, double other, double elsewhere) {
    const double slope = (last - first) / width;
    if (!(std::abs(elsewhere) > 0) || elsewhere == width) return -first / slope;
    const double bend = ((other - first) / elsewhere - slope) / (elsewhere - width);
    const double b = slope - bend * width;
    const double size = std::sqrt(std::max(0.0, b * b - 4 * bend * first));
    return b > 0 ? -2 * first / (b + size) : (size - b) / (2 * bend);
}

/// A part of the step at whose beginning no condition holds and at whose end one does.
struct Bracket {
    Probe first, last;
    Probe other;  ///< One outside it, or the first one itself.

    double width() const { return last.part - first.part; }

    /// Where the first of the margins that are positive at the end will be 0.
    double estimate() const {
        double least = width();
        for (std::size_t k = 0; k < first.margins.size(); ++k) {
            for (std::size_t cell = 0; cell < last.margins[k].size(); ++cell) {
                const double from = first.margins[k][cell], to = last.margins[k][cell];
                if (!(to > 0)) continue;
                const double root = from > 0 ? 0
                                             : root_of(from, to, width(), other.margins[k][cell],
                                                       other.part - first.part);
                // The negation keeps the half where a margin is not finite.
                least = std::min(least, !(root >= 0 && root <= width()) ? width() / 2 : root);
            }
        }
        return first.part + least;
    }

    void narrow(Probe at, bool holds) {
        Probe& end = holds ? last : first;
        other = std::exchange(end, std::move(at));
    }
};

/// Narrows a bracket from estimates, alternately from both sides, so that it becomes as short as
/// asked soon after they are good; wherever it lags behind bisection, by bisection (as in the ITP
/// method: I. Oliveira, R. Takahashi, "An Enhancement of the Bisection Method Average Performance
/// Preserving Minmax Optimality", ACM Trans. Math. Software 47(1), 2020). `look` gives the probe
/// at a part.
Result<void> narrow(Bracket& bracket, int power,
                    const std::function<Result<Probe>(double part)>& look) {
    const double part_to_find = std::ldexp(1, power);
    double beyond = part_to_find / 2, estimate_before = -1;
    for (int left = more_than_bisection - power - 1; bracket.width() > part_to_find; --left) {
        const double begin = bracket.first.part, end = bracket.last.part;
        const double estimate = bracket.estimate();
        const bool is_near_begin = estimate - begin < end - estimate;
        const double further = std::min(beyond, bracket.width() / 2);
        double part = is_near_begin ? estimate + further : estimate - further;
        const double longest = std::ldexp(part_to_find, left);
        part = std::clamp(part, begin + part_to_find / 2, end - part_to_find / 2);
        part = std::max(end - longest, std::min(begin + longest, part));
        Result<Probe> found = look(part);
        if (!found) return tl::unexpected(found.error());
        const bool holds = !found->events().empty();
        bracket.narrow(std::move(*found), holds);
        // Rounding makes margins rough, so that estimates no longer become better.
        const bool has_settled = std::abs(estimate - estimate_before) < 4 * beyond;
        if (holds != is_near_begin && has_settled) beyond *= 4;
        estimate_before = estimate;
    }
    return {};
}

}  // namespace

CellEvents events_at(const TissueRules::Conditions& conditions, std::vector<Field>& state,
                     const Tissue& tissue, const StepMoment& moment, ValueRunner& runner) {
    return probe(conditions, state, tissue, moment, runner).events();
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
    const auto probe_at = [&](std::vector<Field>& state, double part) -> Result<Probe> {
        const auto reached = ends.reach(state);
        if (!reached) return tl::unexpected(reached.error());
        Probe result = probe(conditions, state, tissue, moment_at(part), runner);
        result.part = part;
        return result;
    };
    Result<Probe> at_end = probe_at(ends.new_state, 1);
    if (!at_end) return tl::unexpected(at_end.error());
    const CellEvents last_events = at_end->events();
    if (last_events.empty()) return std::nullopt;
    std::vector<Field> new_rates = rates_at(ends.new_state, 1);
    Result<Probe> at_beginning = probe_at(ends.old_state, 0);
    if (!at_beginning) return tl::unexpected(at_beginning.error());
    Cubic cubic(ends, rates_at(ends.old_state, 0), std::move(new_rates));
    const auto look = [&](double part) { return probe_at(cubic.at(part), part); };
    Bracket bracket{*at_beginning, std::move(*at_end), *at_beginning};
    if (const auto narrowed = narrow(bracket, power_of(tissue.precision()), look); !narrowed) {
        return tl::unexpected(narrowed.error());
    }
    FirstEvents first{bracket.last.part, bracket.last.events()};
    if (window == 0 || first.part == 1) return first;
    const double part = first.part + window;
    CellEvents soon = last_events;
    if (part < 1) {
        const Result<Probe> at_part = look(part);
        if (!at_part) return tl::unexpected(at_part.error());
        soon = at_part->events();
    }
    first.events.dying = united(first.events.dying, soon.dying);
    const std::vector<std::uint32_t> dividing = united(first.events.dividing, soon.dividing);
    first.events.dividing.clear();
    std::set_difference(dividing.begin(), dividing.end(), first.events.dying.begin(),
                        first.events.dying.end(), std::back_inserter(first.events.dividing));
    return first;
}

}  // namespace cascade
