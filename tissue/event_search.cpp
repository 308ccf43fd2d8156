// Searches for roots of margins on the cubic through a step. If conditions depend only on the cell
// itself, they are evaluated for all candidates at once, each at its own moment.
#include "tissue/event_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

struct Weights {
    Weights(double part, double step)
        : of_old((1 + 2 * part) * (1 - part) * (1 - part)),
          of_new(part * part * (3 - 2 * part)),
          of_old_rate(step * part * (1 - part) * (1 - part)),
          of_new_rate(-step * part * part * (1 - part)) {}

    template <typename Number>
    Number sum(const StepCubic& cubic, std::size_t species, std::int64_t at) const {
        const auto in = [&](const std::vector<Field>& state) {
            return state[species].template origin<Number>()[at];
        };
        return static_cast<Number>(
            of_old * in(cubic.old_state) + of_new * in(cubic.new_state) +
            (of_old_rate * in(cubic.old_rates) + of_new_rate * in(cubic.new_rates)));
    }

    double of_old, of_new, of_old_rate, of_new_rate;
};

/// The exponent of the error of moments, which is 2^exponent of a step. In single precision,
/// species change by less than their rounding in shorter parts of a step.
int power_of(Precision precision) { return precision == Precision::single ? -16 : -20; }
/// If margins are not smooth, the search takes at most this many probes more than bisection. If
/// margins are smooth, it takes a fifth of the probes of bisection.
constexpr int more_than_bisection = 4;

/// The values of the conditions of dying and of dividing. A condition holds where its value is
/// above 0.
using Margins = std::array<double, 2>;
constexpr Margins never{-1, -1};

bool holds(const Margins& margins) { return margins[0] > 0 || margins[1] > 0; }

/// The values of the conditions for some cells at one moment of the step.
struct Probe {
    double part = 0;
    std::vector<Margins> margins;

    bool holds() const {
        return std::any_of(margins.begin(), margins.end(),
                           [](const Margins& each) { return cascade::holds(each); });
    }
};

/// Reads the values of conditions for some cells from planes.
std::vector<Margins> margins_of(const TissueRules::Conditions& conditions,
                                const std::vector<Field>& values, const Tissue& tissue,
                                std::span<const std::uint32_t> cells) {
    std::vector<Margins> result(cells.size(), never);
    const std::array planes{conditions.die, conditions.divide};
    for (std::size_t k = 0; k < planes.size(); ++k) {
        if (!planes[k]) continue;
        values[*planes[k]].visit([&](const auto& plane) {
            for (std::size_t n = 0; n < cells.size(); ++n) {
                if (tissue.is_frozen(cells[n])) continue;
                result[n][k] = static_cast<double>(plane.origin()[tissue.element(cells[n])]);
            }
        });
    }
    return result;
}

/// The root between 0 and `width` of a parabola. The parabola has the values `first` ≤ 0 at 0,
/// `last` > 0 at `width` and `other` at `elsewhere`. If there is no third point, the root of the
/// straight line through the first two.
double root_of(double first, double last, double width, double other, double elsewhere) {
    const double slope = (last - first) / width;
    if (!(std::abs(elsewhere) > 0) || elsewhere == width) return -first / slope;
    const double bend = ((other - first) / elsewhere - slope) / (elsewhere - width);
    const double b = slope - bend * width;
    const double size = std::sqrt(std::max(0.0, b * b - 4 * bend * first));
    return b > 0 ? -2 * first / (b + size) : (size - b) / (2 * bend);
}

/// A part of the step that contains the events of some cells. At its beginning no condition holds
/// for these cells. At its end a condition holds. Estimates of the root narrow the bracket
/// alternately from both sides, so that it becomes short soon after the estimates are good.
/// Bisection replaces the estimates where it would be faster, as in the ITP method (I. Oliveira, R.
/// Takahashi, "An Enhancement of the Bisection Method Average Performance Preserving Minmax
/// Optimality", ACM Trans. Math. Software 47(1), 2020).
class Bracket {
public:
    Bracket(std::vector<std::uint32_t> cells, std::vector<Margins> at_end, int power)
        : last{1, std::move(at_end)},
          cells_(std::move(cells)),
          wanted_(std::ldexp(1, power)),
          left_(more_than_bisection - power),
          beyond_(wanted_ / 2) {}

    std::span<const std::uint32_t> cells() const { return cells_; }
    bool is_narrow() const { return !first.margins.empty() && width() <= wanted_; }

    /// The next moment to probe, as a fraction of the step. The first call returns the beginning of
    /// the bracket.
    double next() {
        if (first.margins.empty()) return 0;
        --left_;
        estimate_ = estimate();
        is_near_begin_ = estimate_ - first.part < last.part - estimate_;
        const double further = std::min(beyond_, width() / 2);
        double part = is_near_begin_ ? estimate_ + further : estimate_ - further;
        const double longest = std::ldexp(wanted_, left_);
        part = std::clamp(part, first.part + wanted_ / 2, last.part - wanted_ / 2);
        return std::max(last.part - longest, std::min(first.part + longest, part));
    }

    /// Narrows the bracket by the result of a probe.
    void narrow(Probe at) {
        if (first.margins.empty()) {
            first = other_ = std::move(at);
            return;
        }
        const bool holds = at.holds();
        Probe& end = holds ? last : first;
        other_ = std::exchange(end, std::move(at));
        // If estimates no longer improve, margins are rough because of rounding.
        const bool has_settled = std::abs(estimate_ - estimate_before_) < 4 * beyond_;
        if (holds != is_near_begin_ && has_settled) beyond_ *= 4;
        estimate_before_ = estimate_;
    }

    Probe first, last;

private:
    double width() const { return last.part - first.part; }

    /// Estimates the first moment at which a margin that is positive at the end becomes 0.
    double estimate() const {
        double least = width();
        for (std::size_t n = 0; n < cells_.size(); ++n) {
            for (std::size_t k = 0; k < never.size(); ++k) {
                const double from = first.margins[n][k], to = last.margins[n][k];
                if (!(to > 0)) continue;
                const double root = from > 0 ? 0
                                             : root_of(from, to, width(), other_.margins[n][k],
                                                       other_.part - first.part);
                // If the root is NaN because a margin is not finite, the comparison is false and
                // the middle is taken.
                least = std::min(least, !(root >= 0 && root <= width()) ? width() / 2 : root);
            }
        }
        return first.part + least;
    }

    std::vector<std::uint32_t> cells_;
    Probe other_;  ///< A probe outside of the bracket or, at first, at its beginning.
    double wanted_;
    int left_;
    double beyond_, estimate_ = 0, estimate_before_ = -1;
    bool is_near_begin_ = false;
};

/// The search within one step.
class EventSearch {
public:
    EventSearch(const TissueRules::Conditions& conditions, const StepCubic& cubic,
                const Tissue& tissue, ValueRunner& runner)
        : conditions_(conditions), cubic_(cubic), tissue_(tissue), runner_(runner) {
        for (const Field& field : cubic.new_state) state_.push_back(field.clone());
    }

    Result<void> narrow(std::vector<Bracket>& brackets, const Reach& reach) {
        for (;;) {
            std::vector<Bracket*> open;
            for (Bracket& bracket : brackets) {
                if (!bracket.is_narrow()) open.push_back(&bracket);
            }
            if (open.empty()) return {};
            if (auto looked = look(open, reach); !looked) return looked;
        }
    }

private:
    Result<void> look(const std::vector<Bracket*>& brackets, const Reach& reach) {
        const bool is_alone = conditions_.values.is_of_cell_alone;
        std::vector<double> parts;
        std::vector<std::uint32_t> cells;
        for (Bracket* const bracket : brackets) {
            parts.push_back(bracket->next());
            if (!is_alone) cubic_.put_all(state_, parts.back());
            for (const std::uint32_t cell : bracket->cells()) {
                if (is_alone) cubic_.put(state_, tissue_.element(cell), parts.back());
                cells.push_back(cell);
            }
        }
        if (!is_alone) {
            if (auto reached = reach(state_); !reached) return reached;
        }
        const std::vector<Field>& values =
            runner_.run(conditions_.values, state_, tissue_, cubic_.moment_after(parts[0]), cells);
        for (std::size_t k = 0; k < brackets.size(); ++k) {
            brackets[k]->narrow(
                {parts[k], margins_of(conditions_, values, tissue_, brackets[k]->cells())});
        }
        return {};
    }

    const TissueRules::Conditions& conditions_;
    const StepCubic& cubic_;
    const Tissue& tissue_;
    ValueRunner& runner_;
    std::vector<Field> state_;
};

std::vector<CellEvent> events_of(std::span<const Margins> margins,
                                 std::span<const std::uint32_t> cells) {
    std::vector<CellEvent> events;
    for (std::size_t n = 0; n < cells.size(); ++n) {
        if (!holds(margins[n])) continue;
        events.emplace_back();
        events.back().cell = cells[n];
        events.back().dies = margins[n][0] > 0;
    }
    return events;
}

}  // namespace

StepMoment StepCubic::moment_after(double part) const {
    StepMoment after = moment;
    after.t += part * moment.length;
    return after;
}

std::vector<double> StepCubic::values(std::int64_t element, double part) const {
    const Weights weights(part, moment.length);
    std::vector<double> result;
    for (std::size_t k = 0; k < new_state.size(); ++k) {
        new_state[k].visit([&]<typename Number>(const Plane<Number>&) {
            result.push_back(double{weights.sum<Number>(*this, k, element)});
        });
    }
    return result;
}

void StepCubic::put(std::vector<Field>& state, std::int64_t element, double part) const {
    const Weights weights(part, moment.length);
    for (std::size_t k = 0; k < state.size(); ++k) {
        state[k].visit([&]<typename Number>(Plane<Number>& plane) {
            plane.origin()[element] = weights.sum<Number>(*this, k, element);
        });
    }
}

void StepCubic::put_all(std::vector<Field>& state, double part) const {
    const Weights weights(part, moment.length);
    for (std::size_t k = 0; k < state.size(); ++k) {
        state[k].visit([&]<typename Number>(Plane<Number>& plane) {
            const PlaneLayout& layout = plane.layout();
            for (std::int64_t row = 0; row < layout.row_count(); ++row) {
                const std::int64_t first = layout.row_start(row);
                for (std::int64_t at = first; at < first + layout.width; ++at) {
                    plane.origin()[at] = weights.sum<Number>(*this, k, at);
                }
            }
        });
    }
}

std::vector<CellEvent> events_at(const TissueRules::Conditions& conditions,
                                 std::vector<Field>& state, const Tissue& tissue,
                                 const StepMoment& moment, ValueRunner& runner,
                                 std::span<const std::uint32_t> among) {
    if (conditions.values.problem == nullptr) return {};
    const std::vector<Field>& values = runner.run(conditions.values, state, tissue, moment, among);
    const std::span<const std::uint32_t> cells = among.empty() ? tissue.by_number() : among;
    return events_of(margins_of(conditions, values, tissue, cells), cells);
}

Result<std::vector<CellEvent>> events_within(const TissueRules::Conditions& conditions,
                                             const StepCubic& cubic, const Tissue& tissue,
                                             ValueRunner& runner, const Reach& reach) {
    const bool is_alone = conditions.values.is_of_cell_alone;
    if (!is_alone) {
        if (auto reached = reach(cubic.new_state); !reached) return tl::unexpected(reached.error());
    }
    const std::vector<Field>& values =
        runner.run(conditions.values, cubic.new_state, tissue, cubic.moment_after(1));
    const std::vector<Margins> margins = margins_of(conditions, values, tissue, tissue.by_number());
    std::vector<std::uint32_t> cells;
    std::vector<Margins> at_end;
    for (std::size_t rank = 0; rank < margins.size(); ++rank) {
        if (!holds(margins[rank])) continue;
        cells.push_back(tissue.by_number()[rank]);
        at_end.push_back(margins[rank]);
    }
    std::vector<CellEvent> events;
    if (cells.empty()) return events;
    const int power = power_of(tissue.precision());
    std::vector<Bracket> brackets;
    if (is_alone) {
        for (std::size_t n = 0; n < cells.size(); ++n) {
            brackets.push_back(Bracket({cells[n]}, {at_end[n]}, power));
        }
    } else {
        brackets.push_back(Bracket(cells, at_end, power));
    }
    EventSearch search(conditions, cubic, tissue, runner);
    if (auto narrowed = search.narrow(brackets, reach); !narrowed) {
        return tl::unexpected(narrowed.error());
    }
    for (const Bracket& bracket : brackets) {
        for (CellEvent& event : events_of(bracket.last.margins, bracket.cells())) {
            event.part = bracket.last.part;
            events.push_back(std::move(event));
        }
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const CellEvent& a, const CellEvent& b) { return a.part < b.part; });
    return events;
}

}  // namespace cascade
