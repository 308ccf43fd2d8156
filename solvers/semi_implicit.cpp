// Writes the schemes as lists of sweeps. Each sweep evaluates rates, or adds a filter's results to
// the old step.
#include "solvers/semi_implicit.h"

#include <utility>

namespace cascade {
namespace {

using Source = SweepTerm::Source;
using Weight = SweepTerm::Weight;

/// Computes c · change + old. The change is the second input.
SweepForm sum_form() {
    SweepForm form;
    // A filter spreads the changes of free cells into frozen cells, which must keep their values.
    form.holds = true;
    form.inputs = 2;
    form.coefficients = 1;
    form.outputs = {{SweepOutput::Kind::state,
                     {{Source::value, 1, Weight::coefficient, 0}, {Source::value, 0}}}};
    return form;
}

/// Adds two sweeps. The first writes the rates at `from`. The second filters them and adds the
/// result to the old step.
void add_stage(Scheme& scheme, RegisterId change, RegisterId from, double time,
               SweepFilter filter) {
    Sweep rate, sum;
    rate.time = time;
    rate.inputs = {from};
    rate.outputs = {change};
    sum.form = 1;
    sum.filter = std::move(filter);
    sum.inputs = {old_register, change};
    sum.outputs = {new_register};
    sum.coefficients = {{1, true}};
    scheme.sweeps.push_back(std::move(rate));
    scheme.sweeps.push_back(std::move(sum));
}

}  // namespace

Scheme one_filter(WaveResponse response) {
    Scheme scheme;
    const RegisterId change = scheme.add_register();
    scheme.forms = {rate_form(), sum_form()};
    add_stage(scheme, change, old_register, 0, {change, response});
    return scheme;
}

Scheme etdrk4() {
    Scheme scheme;
    const RegisterId change = scheme.add_register();
    std::vector<RegisterId> kept;
    for (std::size_t k = 0; k < etd_registers; ++k) kept.push_back(scheme.add_register());
    scheme.forms = {rate_form(), sum_form()};
    // All points but the last are stored in the new step's register.
    add_stage(scheme, change, old_register, 0, {change, WaveResponse::etd_first, kept});
    add_stage(scheme, change, new_register, 0.5, {change, WaveResponse::etd_second, kept});
    add_stage(scheme, change, new_register, 0.5, {change, WaveResponse::etd_third, kept});
    add_stage(scheme, change, new_register, 1, {change, WaveResponse::etd_last, kept});
    return scheme;
}

}  // namespace cascade
