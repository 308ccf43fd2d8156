// Copies the species before each step in which a moment may be observed. Evaluates rates only for
// steps in which a moment is observed.
#include "run/simulation/between_steps.h"

#include "core/check.h"
#include "lang/program/nodes_of_rates.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace cascade {

namespace {

/// The largest rounding error of a sum of step lengths, as a fraction of one step.
constexpr double rounding_of_moments = 1e-6;

/// The weights of the five numbers that give a value at the fraction `s` of a step: the values and
/// slopes at both ends, by Hermite's cubic, and the quartic term, which changes neither values nor
/// slopes at the ends. Slopes and the quartic term are first multiplied by the length of the step.
struct HermiteWeights {
    double before, after, slope_before, slope_after, quartic;

    explicit HermiteWeights(double s)
        : before((1 + 2 * s) * (1 - s) * (1 - s)),
          after(s * s * (3 - 2 * s)),
          slope_before(s * (1 - s) * (1 - s)),
          slope_after(-s * s * (1 - s)),
          quartic(s * s * (1 - s) * (1 - s)) {}
};

/// Whether a cubic is smooth within a step. The value changes by `change` over the step. With the
/// slope at the start of the step alone, it would change by `at_start`, and with the slope at the
/// end alone by `at_end`. For a smooth curve, the differences of these two from `change` are of
/// second order in the length of the step, and the sum of the differences is of third order.
bool is_smooth(double change, double at_start, double at_end) {
    const double first = at_start - change, last = at_end - change;
    return std::abs(first + last) <= (std::abs(first) + std::abs(last)) / 2;
}

/// Replaces `after` by `value(before, after, row, cell)` in each cell in which `before` and `after`
/// differ.
template <typename Number, typename Value>
void read_between(const Plane<Number>& before, Plane<Number>& after, const Value& value) {
    const PlaneLayout& layout = after.layout();
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        const Number* const from = before.row(row);
        Number* const to = after.row(row);
        for (std::int64_t i = 0; i < layout.width; ++i) {
            if (from[i] != to[i]) to[i] = static_cast<Number>(value(from[i], to[i], row, i));
        }
    }
}

}  // namespace

BetweenSteps::BetweenSteps(const StageView& view, StageState& state, bool has_long_steps,
                           std::function<std::vector<Field>()> curve)
    : view_(view),
      state_(state),
      has_long_steps_(has_long_steps),
      curve_(std::move(curve)),
      has_slopes_(!holds_in_rates(view.system(), is_draw)),
      last_(state.t) {}

void BetweenSteps::pass(const NextMoment& next, const std::function<void()>& observe,
                        const std::atomic<bool>& cancel) {
    const std::int64_t step = state_.steps;
    const double t = state_.t;
    const bool follows = before_ && before_->step + 1 == step;
    const double length = follows ? t - before_->t : state_.time.clock.step;
    slopes_before_.clear();
    slopes_after_.clear();
    double moment = next(last_);
    for (; moment <= t + rounding_of_moments * length && !cancel; moment = next(last_)) {
        last_ = moment;
        if (std::abs(moment - t) <= rounding_of_moments * length) {
            observe();
            continue;
        }
        CHECK(follows, "a copy of the step before a moment");
        {
            const OtherSpecies read(state_, at(moment));
            state_.go_to(step, moment);
            observe();
        }
        state_.go_to(step, t);
    }
    before_.reset();
    keep_before(moment);
}

/// If a solver chooses its steps, a step may have any length, so the next step may pass any finite
/// moment.
void BetweenSteps::keep_before(double next_moment) {
    const bool may_follow = view_.stage().time.chooses_steps()
                                ? std::isfinite(next_moment)
                                : next_moment - state_.t < 1.01 * state_.time.clock.step;
    if (!may_follow) return;
    before_.emplace(Moment{state_.steps, state_.t, {}});
    for (const Field& field : state_.species()) before_->species.push_back(field.clone());
}

std::vector<Field> BetweenSteps::rates_before() {
    const std::int64_t step = state_.steps;
    const double t = state_.t;
    std::vector<Field> rates;
    {
        std::vector<Field> copies;
        for (const Field& field : before_->species) copies.push_back(field.clone());
        const OtherSpecies then(state_, std::move(copies));
        state_.go_to(before_->step, before_->t);
        rates = view_.rates();
    }
    state_.go_to(step, t);
    return rates;
}

std::vector<Field> BetweenSteps::at(double t) {
    const double length = state_.t - before_->t, s = (t - before_->t) / length;
    if (has_slopes_ && slopes_before_.empty()) {
        slopes_before_ = rates_before();
        slopes_after_ = view_.rates();
        quartic_ = curve_();
    }
    const HermiteWeights weights(s);
    std::vector<Field> read;
    for (std::size_t k = 0; k < state_.species().size(); ++k) {
        read.push_back(state_.species()[k].clone());
        read.back().visit([&](auto& plane) {
            using Number = std::remove_pointer_t<decltype(plane.origin())>;
            const auto& before = before_->species[k].plane<Number>();
            const auto line = [&](double from, double to) { return from + s * (to - from); };
            if (!has_slopes_) {
                return read_between(before, plane, [&](double from, double to, auto, auto) {
                    return line(from, to);
                });
            }
            const auto& slope_before = slopes_before_[k].plane<Number>();
            const auto& slope_after = slopes_after_[k].plane<Number>();
            const auto* const quartic = quartic_.empty() ? nullptr : &quartic_[k].plane<Number>();
            read_between(before, plane,
                         [&](double from, double to, std::int64_t row, std::int64_t i) {
                             const double first = length * slope_before.row(row)[i];
                             const double last = length * slope_after.row(row)[i];
                             if (has_long_steps_ && !is_smooth(to - from, first, last))
                                 return line(from, to);
                             const double more =
                                 quartic == nullptr ? 0 : length * quartic->row(row)[i];
                             return weights.before * from + weights.after * to +
                                    (weights.slope_before * first + weights.slope_after * last +
                                     weights.quartic * more);
                         });
        });
    }
    return read;
}

}  // namespace cascade
