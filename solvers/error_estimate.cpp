// Compares the step with the trapezoidal rule: the error is the mean of the rates at both ends
// times the step, minus the change of the step. For etdrk4 the last filter gives the error, and for
// ros2 the last sweep.
#include "solvers/error_estimate.h"

#include "solvers/rosenbrock.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace cascade {
namespace {

using Source = SweepTerm::Source;
using Weight = SweepTerm::Weight;

/// The sweep that computes the error. Inputs: the new step, the old step and the rates at the old
/// step. Outputs: the error and the rates at the new step.
SweepForm error_form() {
    SweepForm form;
    form.inputs = 3;
    form.base_input = 1;
    form.coefficients = 3;
    form.outputs = {{SweepOutput::Kind::change,
                     {{Source::value, 2, Weight::coefficient, 0},
                      {Source::rate, 0, Weight::coefficient, 1},
                      {Source::difference, 0, Weight::coefficient, 2}}},
                    {SweepOutput::Kind::change, {{Source::rate}}}};
    return form;
}

/// Makes the first sweep read the rates at the old step instead of evaluating them.
void read_first_rates(Scheme& scheme, RegisterId first_rate) {
    Sweep& first = scheme.sweeps.front();
    SweepForm form = scheme.forms[first.form];
    for (SweepOutput& output : form.outputs) {
        for (SweepTerm& term : output.terms) {
            if (term.source != Source::rate) continue;
            term.source = Source::value;
            term.input = form.inputs;
        }
    }
    ++form.inputs;
    first.inputs.push_back(first_rate);
    const auto uses_it = [&](const Sweep& sweep) { return sweep.form == first.form; };
    if (std::count_if(scheme.sweeps.begin(), scheme.sweeps.end(), uses_it) > 1) {
        first.form = static_cast<std::uint32_t>(scheme.forms.size());
        scheme.forms.emplace_back();
    }
    scheme.forms[first.form] = std::move(form);
}

/// Adds the error that the scheme's last filter finds. The filter writes the error per unit of
/// time, and an added sweep multiplies this by the step.
Scheme with_error_of_filter(Scheme scheme) {
    const RegisterId error = scheme.add_register();
    scheme.error_register = error;
    scheme.sweeps.back().filter->error = error;
    SweepForm form;
    form.inputs = 2;
    form.coefficients = 1;
    form.outputs = {{SweepOutput::Kind::change, {{Source::value, 1, Weight::coefficient, 0}}}};
    Sweep sweep;
    sweep.form = static_cast<std::uint32_t>(scheme.forms.size());
    sweep.time = 1;
    sweep.inputs = {new_register, error};
    sweep.outputs = {error};
    sweep.coefficients = {{1, true}};
    scheme.forms.push_back(std::move(form));
    scheme.sweeps.push_back(std::move(sweep));
    return scheme;
}

}  // namespace

Scheme with_error_estimate(Scheme scheme) {
    if (scheme.forms.back().equations) return with_embedded_error(std::move(scheme));
    const std::optional<SweepFilter>& filter = scheme.sweeps.back().filter;
    if (filter && filter->response == WaveResponse::etd_last) {
        return with_error_of_filter(std::move(scheme));
    }
    const RegisterId first_rate = scheme.add_register(), last_rate = scheme.add_register();
    scheme.rate_registers = {first_rate, last_rate};
    scheme.error_register = scheme.add_register();
    read_first_rates(scheme, first_rate);
    const auto forms = static_cast<std::uint32_t>(scheme.forms.size());
    scheme.forms.push_back(rate_form());
    scheme.forms.push_back(error_form());
    Sweep first, error;
    first.form = forms;
    first.inputs = {old_register};
    first.outputs = {first_rate};
    scheme.sweeps.insert(scheme.sweeps.begin(), std::move(first));
    error.form = forms + 1;
    error.time = 1;
    error.inputs = {new_register, old_register, first_rate};
    error.outputs = {*scheme.error_register, last_rate};
    error.coefficients = {{0.5, true}, {0.5, true}, {-1, false}};
    scheme.sweeps.push_back(std::move(error));
    return scheme;
}

}  // namespace cascade
