// The schemes as lists of sweeps: rates, then sums of rates after a filter has damped them. The
// Rosenbrock method has γ = 1 − 1/√2.
#include "solvers/semi_implicit.h"

#include <cmath>
#include <utility>

namespace cascade {
namespace {

using Source = SweepTerm::Source;
using Weight = SweepTerm::Weight;

/// c₀ · change + c₁ · change + … + old; the changes are the inputs after the old step.
SweepForm sum_form(std::uint32_t changes) {
    SweepForm form;
    form.holds = true;  // A filter spreads the changes of free cells into frozen ones.
    form.inputs = 1 + changes;
    form.coefficients = changes;
    std::vector<SweepTerm> terms;
    for (std::uint32_t k = 0; k < changes; ++k) {
        terms.push_back({Source::value, 1 + k, Weight::coefficient, k});
    }
    terms.push_back({Source::value, 0});
    form.outputs = {{SweepOutput::Kind::state, std::move(terms)}};
    return form;
}

}  // namespace

Scheme one_filter(WaveResponse response) {
    Scheme scheme;
    const RegisterId change = scheme.add_register();
    scheme.forms = {rate_form(), sum_form(1)};
    Sweep rate, sum;
    rate.inputs = {old_register};
    rate.outputs = {change};
    sum.form = 1;
    sum.filter = SweepFilter{change, response, 1};
    sum.inputs = {old_register, change};
    sum.outputs = {new_register};
    sum.coefficients = {{1, true}};
    scheme.sweeps = {std::move(rate), std::move(sum)};
    return scheme;
}

Scheme rosenbrock() {
    const double gamma = 1 - 1 / std::sqrt(2.0);
    Scheme scheme;
    const RegisterId first = scheme.add_register(), state = scheme.add_register(),
                     second = scheme.add_register();
    scheme.lower_order_register = state;
    // f − 2 k₁: inputs are the state, then k₁.
    SweepForm second_rate = rate_form();
    second_rate.inputs = 2;
    second_rate.coefficients = 1;
    second_rate.outputs[0].terms.push_back({Source::value, 1, Weight::coefficient, 0});
    scheme.forms = {rate_form(), sum_form(1), std::move(second_rate), sum_form(2)};
    scheme.sweeps.resize(4);
    Sweep& rate = scheme.sweeps[0];
    rate.inputs = {old_register};
    rate.outputs = {first};
    Sweep& ahead = scheme.sweeps[1];
    ahead.form = 1;
    ahead.filter = SweepFilter{first, WaveResponse::implicit, gamma};
    ahead.inputs = {old_register, first};
    ahead.outputs = {state};
    ahead.coefficients = {{1, true}};
    Sweep& again = scheme.sweeps[2];
    again.form = 2;
    again.time = 1;
    again.inputs = {state, first};
    again.outputs = {second};
    again.coefficients = {{-2, false}};
    Sweep& sum = scheme.sweeps[3];
    sum.form = 3;
    sum.filter = SweepFilter{second, WaveResponse::implicit, gamma};
    sum.inputs = {old_register, first, second};
    sum.outputs = {new_register};
    sum.coefficients = {{1.5, true}, {0.5, true}};
    return scheme;
}

}  // namespace cascade
