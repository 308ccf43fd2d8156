// Butcher tableaux as sweeps.
//
// A step without an error estimate stores its stages instead of its rates. Step · k_j is a sum of
// differences between stages, so a sweep writes only one plane of each species.
#include "solvers/runge_kutta.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace cascade {
namespace {

using Source = SweepTerm::Source;
using Weight = SweepTerm::Weight;

/// The term step · `weight` · rate, for the rate that the sweep evaluates.
SweepTerm own_rate(SweepForm& form, Sweep& sweep, double weight) {
    sweep.coefficients.push_back({weight, true});
    return {Source::rate, 0, Weight::coefficient, form.coefficients++};
}

void add(Scheme& scheme, SweepForm form, Sweep sweep) {
    sweep.form = static_cast<std::uint32_t>(scheme.forms.size());
    scheme.forms.push_back(std::move(form));
    scheme.sweeps.push_back(std::move(sweep));
}

double time_of(const std::vector<double>& row) {
    return std::accumulate(row.begin(), row.end(), 0.0);
}

/// A scheme that stores each stage in a register. Differences of stages from the old step replace
/// rates.
class StateScheme {
public:
    explicit StateScheme(const ButcherTableau& tableau) : tableau_(tableau) {}

    Scheme build() && {
        const auto stages = static_cast<std::uint32_t>(tableau_.b.size());
        scheme_.registers = std::max(stages, 3U);
        for (std::uint32_t stage = 0; stage < stages; ++stage) add_stage(stage);
        return std::move(scheme_);
    }

private:
    /// The register of a stage. Stage 0 is the old step. The stage after the last is the new step,
    /// which overwrites stage 1 cell by cell unless rates are evaluated at the new step.
    RegisterId register_of(std::uint32_t stage) const {
        if (stage == 0) return old_register;
        if (stage == tableau_.b.size()) return new_register;
        return RegisterId(tableau_.b.size() == 2 ? stage + 1 : stage);
    }

    const std::vector<double>& row_of(std::uint32_t stage) const {
        return stage < tableau_.b.size() ? tableau_.a[stage] : tableau_.b;
    }

    /// The weights that turn the differences (stage − old) into Σ weights[j] step k_j, without the
    /// term of the last rate. Row j + 1 of the tableau gives k_j from stage j + 1 and the earlier
    /// rates.
    std::vector<double> weights_of_stages(std::vector<double> weights) const {
        std::vector<double> of_stages(weights.size(), 0);
        for (std::size_t stage = weights.size() - 1; stage > 0; --stage) {
            const std::vector<double>& row = tableau_.a[stage];
            const double weight = weights[stage - 1] / row[stage - 1];
            of_stages[stage] = weight;
            for (std::size_t j = 0; j < stage; ++j) weights[j] -= weight * row[j];
        }
        return of_stages;
    }

    /// Adds the sweep that evaluates a stage's rate and writes the next stage.
    void add_stage(std::uint32_t stage) {
        const std::vector<double>& row = row_of(stage + 1);
        SweepForm form;
        Sweep sweep;
        sweep.inputs = {register_of(stage)};
        sweep.outputs = {register_of(stage + 1)};
        sweep.time = time_of(tableau_.a[stage]);
        if (stage > 0) {
            form.base_input = form.inputs++;
            sweep.inputs.push_back(old_register);
        }
        SweepOutput state;
        const std::vector<double> weights = weights_of_stages(row);
        for (std::uint32_t other = 1; other < weights.size(); ++other) {
            if (std::abs(weights[other]) < 1e-14) continue;
            std::uint32_t input = 0;
            if (other != stage) {
                input = form.inputs++;
                sweep.inputs.push_back(register_of(other));
            }
            state.terms.push_back(
                {Source::difference, input, Weight::coefficient, form.coefficients++});
            sweep.coefficients.push_back({weights[other], false});
        }
        state.terms.push_back(own_rate(form, sweep, row.back()));
        // Adds the old values last, so that the small terms are added to each other first.
        state.terms.push_back({Source::value, form.base_input});
        form.outputs = {std::move(state)};
        add(scheme_, std::move(form), std::move(sweep));
    }

    const ButcherTableau& tableau_;
    Scheme scheme_;
};

/// A scheme that stores each rate in a register, because the error is a small difference of large
/// rates. The error includes the new step's rate, which is also the first rate of the next step.
class EmbeddedScheme {
public:
    explicit EmbeddedScheme(const ButcherTableau& tableau)
        : tableau_(tableau), rate_register_(tableau.b.size()) {}

    Scheme build() && {
        const auto stages = static_cast<std::uint32_t>(tableau_.b.size());
        add_first_rate();
        add_second_state();
        for (std::uint32_t stage = 1; stage < stages; ++stage) add_stage(stage);
        add_error();
        return std::move(scheme_);
    }

private:
    RegisterId state_register(std::uint32_t stage) const {
        return stage == 0 ? old_register : state_registers_[stage % 2];
    }

    /// The row of the tableau that gives the state after a stage: the next stage or the new step.
    const std::vector<double>& row_after(std::uint32_t stage) const {
        return stage + 1 < tableau_.b.size() ? tableau_.a[stage + 1] : tableau_.b;
    }

    /// Whether any row after the next reads the rate of a stage.
    bool is_read_later(std::uint32_t stage) const {
        for (std::uint32_t later = stage + 1; later < tableau_.b.size(); ++later) {
            if (row_after(later)[stage] != 0) return true;
        }
        return tableau_.error[stage] != 0;
    }

    /// Adds the terms step · weights[j] · k_j from the registers of rates, except for the last
    /// weight.
    void add_kept_rates(SweepForm& form, Sweep& sweep, SweepOutput& output,
                        const std::vector<double>& weights) const {
        for (std::size_t j = 0; j + 1 < weights.size(); ++j) {
            if (weights[j] == 0) continue;
            output.terms.push_back(
                {Source::value, form.inputs++, Weight::coefficient, form.coefficients++});
            sweep.inputs.push_back(*rate_register_[j]);
            sweep.coefficients.push_back({weights[j], true});
        }
    }

    /// Stores the rate that a sweep evaluates. Returns its register.
    RegisterId keep_rate(SweepForm& form, Sweep& sweep) {
        form.outputs.push_back({SweepOutput::Kind::change, {{Source::rate}}});
        return sweep.outputs.emplace_back(scheme_.add_register());
    }

    void add_first_rate() {
        SweepForm form;
        Sweep sweep;
        sweep.inputs = {old_register};
        rate_register_[0] = keep_rate(form, sweep);
        add(scheme_, std::move(form), std::move(sweep));
    }

    /// Adds the sweep that writes stage 1 from the first rate. It evaluates no rate, because the
    /// step's length was unknown when the first rate was evaluated.
    void add_second_state() {
        SweepForm form;
        Sweep sweep;
        form.inputs = 2;
        form.coefficients = 1;
        form.outputs = {{SweepOutput::Kind::state,
                         {{Source::value, 1, Weight::coefficient, 0}, {Source::value, 0}}}};
        sweep.inputs = {old_register, *rate_register_[0]};
        sweep.outputs = {state_register(1)};
        sweep.coefficients = {{tableau_.a[1][0], true}};
        add(scheme_, std::move(form), std::move(sweep));
    }

    void add_stage(std::uint32_t stage) {
        SweepForm form;
        Sweep sweep;
        const bool is_last = stage + 1 == tableau_.b.size();
        form.base_input = form.inputs++;
        sweep.inputs = {state_register(stage), old_register};
        sweep.time = time_of(tableau_.a[stage]);
        SweepOutput state;
        const std::vector<double>& weights = row_after(stage);
        add_kept_rates(form, sweep, state, weights);
        state.terms.push_back(own_rate(form, sweep, weights.back()));
        form.ignores_held_rates = weights.back() < 0;
        state.terms.push_back({Source::value, form.base_input});
        form.outputs.push_back(std::move(state));
        sweep.outputs = {is_last ? new_register : state_register(stage + 1)};
        if (is_read_later(stage)) rate_register_[stage] = keep_rate(form, sweep);
        add(scheme_, std::move(form), std::move(sweep));
    }

    void add_error() {
        SweepForm form;
        Sweep sweep;
        form.inputs = 2;
        form.base_input = 1;
        sweep.inputs = {new_register, old_register};
        sweep.time = 1;
        SweepOutput error;
        error.kind = SweepOutput::Kind::change;
        add_kept_rates(form, sweep, error, tableau_.error);
        error.terms.push_back(own_rate(form, sweep, tableau_.error.back()));
        form.outputs = {std::move(error)};
        scheme_.error_register = scheme_.add_register();
        sweep.outputs = {*scheme_.error_register};
        scheme_.rate_registers = {*rate_register_[0], keep_rate(form, sweep)};
        rate_register_.emplace_back(scheme_.rate_registers->last);
        for (std::size_t j = 0; j < tableau_.curve.size(); ++j) {
            if (tableau_.curve[j] == 0) continue;
            scheme_.curve.push_back({*rate_register_[j], tableau_.curve[j]});
        }
        add(scheme_, std::move(form), std::move(sweep));
    }

    const ButcherTableau& tableau_;
    Scheme scheme_;
    /// Stages alternate between these two registers.
    std::array<RegisterId, 2> state_registers_{scheme_.add_register(), scheme_.add_register()};
    /// The register of each stage's rate; nullopt if the rate is not stored.
    std::vector<std::optional<RegisterId>> rate_register_;
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
            {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40},
            {-12715105075.0 / 11282082432, 0, 87487479700.0 / 32700410799,
             -10690763975.0 / 1880347072, 701980252875.0 / 199316789632, -1453857185.0 / 822651844,
             69997945.0 / 29380423}};
}

Scheme explicit_runge_kutta(const ButcherTableau& tableau) {
    return tableau.error.empty() ? StateScheme(tableau).build() : EmbeddedScheme(tableau).build();
}

}  // namespace cascade
