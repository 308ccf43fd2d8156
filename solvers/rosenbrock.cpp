// Builds the scheme from two sweeps. Stores the point of the second evaluation instead of k1, since
// h k1 is the difference between this point and the old step.
#include "solvers/rosenbrock.h"

#include <numbers>

namespace cascade {
namespace {

using Source = SweepTerm::Source;
using Weight = SweepTerm::Weight;

constexpr double gamma = 1 - std::numbers::sqrt2 / 2;

}  // namespace

Scheme ros2() {
    Scheme scheme;
    const RegisterId point = scheme.add_register();

    SweepForm first;
    first.coefficients = 2;
    first.equations = {{{Source::rate, 0, Weight::coefficient, 0}}, 1};
    first.outputs = {{SweepOutput::Kind::state, {{Source::solution}, {Source::value, 0}}}};
    Sweep to_point;
    to_point.inputs = {old_register};
    to_point.outputs = {point};
    to_point.coefficients = {{1, true}, {gamma, true}};

    SweepForm second;
    second.inputs = 2;
    second.base_input = 1;
    second.coefficients = 5;
    second.equations = {{{Source::rate, 0, Weight::coefficient, 0},
                         {Source::difference, 0, Weight::coefficient, 2}},
                        1};
    second.outputs = {{SweepOutput::Kind::state,
                       {{Source::difference, 0, Weight::coefficient, 3},
                        {Source::solution, 0, Weight::coefficient, 4},
                        {Source::value, 1}}}};
    Sweep to_new;
    to_new.form = 1;
    to_new.time = 1;
    to_new.inputs = {point, old_register};
    to_new.outputs = {new_register};
    to_new.coefficients = {{1, true}, {gamma, true}, {-2, false}, {1.5, false}, {0.5, false}};

    scheme.forms = {first, second};
    scheme.sweeps = {to_point, to_new};
    return scheme;
}

Scheme with_embedded_error(Scheme scheme) {
    constexpr std::uint32_t half = 4;  // The index of the coefficient of the solution.
    scheme.error_register = scheme.add_register();
    scheme.forms.back().outputs.push_back({SweepOutput::Kind::change,
                                           {{Source::difference, 0, Weight::coefficient, half},
                                            {Source::solution, 0, Weight::coefficient, half}}});
    scheme.sweeps.back().outputs.push_back(*scheme.error_register);
    return scheme;
}

}  // namespace cascade
