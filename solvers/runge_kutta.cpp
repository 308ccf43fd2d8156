// Butcher tableaux as sweeps.
#include "solvers/runge_kutta.h"

#include <numeric>
#include <utility>

namespace cascade {
namespace {

using Source = SweepTerm::Source;
using Weight = SweepTerm::Weight;

/// Two registers for the states of stages that change places; the rates lie behind them.
constexpr std::uint32_t first_state = 2, first_rate = 4;

class Builder {
public:
    explicit Builder(const ButcherTableau& tableau)
        : tableau_(tableau), rate_register_(tableau.b.size(), 0) {}

    Scheme build() && {
        const auto stages = static_cast<std::uint32_t>(tableau_.b.size());
        for (std::uint32_t stage = 0; stage < stages; ++stage) add_stage(stage);
        if (!tableau_.error.empty()) add_error();
        scheme_.registers = next_register_;
        return std::move(scheme_);
    }

private:
    /// The row that gives the state behind a stage: of the next stage, or the new step.
    const std::vector<double>& row_behind(std::uint32_t stage) const {
        return stage + 1 < tableau_.b.size() ? tableau_.a[stage + 1] : tableau_.b;
    }

    /// Is the rate of a stage read by anything but the row right behind it?
    bool is_read_later(std::uint32_t stage) const {
        for (std::uint32_t later = stage + 1; later < tableau_.b.size(); ++later) {
            if (row_behind(later)[stage] != 0) return true;
        }
        return !tableau_.error.empty() && tableau_.error[stage] != 0;
    }

    /// Adds the terms weights[j] · step · k_j, the last k being the rate of this sweep.
    void add_terms(SweepForm& form, Sweep& sweep, SweepOutput& output,
                   const std::vector<double>& weights) const {
        const std::size_t own = weights.size() - 1;
        for (std::size_t j = 0; j < weights.size(); ++j) {
            if (weights[j] == 0) continue;
            SweepTerm term{Source::rate, 0, Weight::coefficient, form.coefficients++};
            if (j < own) {
                term.source = Source::value;
                term.input = form.inputs++;
                sweep.inputs.push_back(rate_register_[j]);
            }
            output.terms.push_back(term);
            sweep.coefficients.push_back({weights[j], true});
        }
    }

    void add(SweepForm form, Sweep sweep) {
        sweep.form = static_cast<std::uint32_t>(scheme_.forms.size());
        scheme_.forms.push_back(std::move(form));
        scheme_.sweeps.push_back(std::move(sweep));
    }

    void add_stage(std::uint32_t stage) {
        const bool last = stage + 1 == tableau_.b.size();
        SweepForm form;
        Sweep sweep;
        form.last = last;
        sweep.inputs = {stage == 0 ? old_register : first_state + stage % 2};
        sweep.time = std::accumulate(tableau_.a[stage].begin(), tableau_.a[stage].end(), 0.0);
        if (stage > 0) {
            form.old_input = form.inputs++;
            sweep.inputs.push_back(old_register);
        }
        SweepOutput state;
        add_terms(form, sweep, state, row_behind(stage));
        // The old values come last: the small terms are added to each other before.
        state.terms.push_back({Source::value, form.old_input});
        form.outputs.push_back(std::move(state));
        sweep.outputs = {last ? new_register : first_state + (stage + 1) % 2};
        if (is_read_later(stage)) {
            rate_register_[stage] = next_register_++;
            form.outputs.push_back({SweepOutput::Kind::change, {{Source::rate}}});
            sweep.outputs.push_back(rate_register_[stage]);
        }
        add(std::move(form), std::move(sweep));
    }

    void add_error() {
        SweepForm form;
        Sweep sweep;
        form.last = false;
        form.inputs = 2;
        form.old_input = 1;
        sweep.inputs = {new_register, old_register};
        sweep.time = 1;
        SweepOutput error;
        error.kind = SweepOutput::Kind::change;
        add_terms(form, sweep, error, tableau_.error);
        form.outputs = {std::move(error)};
        scheme_.error_register = next_register_++;
        sweep.outputs = {scheme_.error_register};
        add(std::move(form), std::move(sweep));
    }

    const ButcherTableau& tableau_;
    Scheme scheme_;
    std::vector<std::uint32_t> rate_register_;  ///< By stage; 0 where none is kept.
    std::uint32_t next_register_ = first_rate;
};

}  // namespace

ButcherTableau midpoint() { return {{{}, {0.5}}, {0, 1}, {}}; }

ButcherTableau classical() {
    return {{{}, {0.5}, {0, 0.5}, {0, 0, 1}}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}, {}};
}

ButcherTableau bogacki_shampine() {
    return {{{}, {0.5}, {0, 0.75}},
            {2.0 / 9, 1.0 / 3, 4.0 / 9},
            {-5.0 / 72, 1.0 / 12, 1.0 / 9, -1.0 / 8}};
}

ButcherTableau dormand_prince() {
    return {{{},
             {1.0 / 5},
             {3.0 / 40, 9.0 / 40},
             {44.0 / 45, -56.0 / 15, 32.0 / 9},
             {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
             {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656}},
            {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
            {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525,
             -1.0 / 40}};
}

Scheme explicit_runge_kutta(const ButcherTableau& tableau) { return Builder(tableau).build(); }

}  // namespace cascade
