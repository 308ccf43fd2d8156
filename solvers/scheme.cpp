// Schemes of one sweep and stabilised schemes. Butcher tableaux are in runge_kutta.cpp, schemes
// that filter waves in semi_implicit.cpp, and the scheme that solves equations in each cell in
// rosenbrock.cpp.
//
// Stabilised Runge-Kutta-Legendre: C. D. Meyer, D. S. Balsara, T. D. Aslam, "A stabilized
// Runge-Kutta-Legendre method for explicit super-time-stepping of parabolic and mixed equations",
// Journal of Computational Physics 257, 2014, 594-626: equations 17 (first order) and 27 (second).
#include "solvers/scheme.h"

#include "core/check.h"
#include "solvers/rosenbrock.h"
#include "solvers/runge_kutta.h"
#include "solvers/semi_implicit.h"

#include <algorithm>

namespace cascade {
namespace {

using Source = SweepTerm::Source;
using Weight = SweepTerm::Weight;

Scheme euler(bool by_item) {
    Scheme scheme;
    SweepForm form;
    Sweep sweep;
    SweepTerm rate{Source::rate, 0, by_item ? Weight::speed : Weight::coefficient, 0};
    if (!by_item) {
        form.coefficients = 1;
        sweep.coefficients = {{1, true}};
    }
    form.outputs = {{SweepOutput::Kind::state, {{}, rate}}};
    sweep.inputs = {old_register};
    sweep.outputs = {new_register};
    scheme.forms = {form};
    scheme.sweeps = {sweep};
    return scheme;
}

/// One sweep for each species, in the order in which they are written. Each sweep reads the new
/// values of the species written before.
Scheme symplectic(std::uint32_t species, bool by_item) {
    const Scheme whole = euler(by_item);
    Scheme scheme;
    for (std::uint32_t number = 0; number < species; ++number) {
        scheme.forms.push_back(whole.forms[0]);
        scheme.forms.back().species = {SpeciesId(number)};
        scheme.sweeps.push_back(whole.sweeps[0]);
        scheme.sweeps.back().form = number;
        scheme.sweeps.back().renewed = number;
    }
    return scheme;
}

/// The register of the state after part j of a step. Part 0 is the old step and the last part the
/// new one. Parts between them alternate between two registers, because part j may overwrite part j
/// − 2 cell by cell.
RegisterId register_of_part(std::uint32_t j, std::uint32_t parts) {
    if (j == 0) return old_register;
    return (parts - j) % 2 == 0 ? new_register : first_scratch_register;
}
constexpr std::uint32_t registers_of_parts = 3;

/// Y₁ = Y₀ + μ̃₁ τ L(Y₀).
SweepForm first_legendre_form() {
    SweepForm form;
    form.coefficients = 1;
    form.outputs = {{SweepOutput::Kind::state, {{}, {Source::rate, 0, Weight::coefficient, 0}}}};
    return form;
}

/// Y_j = ((j − 1)/j (Y_{j−1} − Y_{j−2}) + μ̃ τ L(Y_{j−1})) + Y_{j−1}. This is the paper's sum in
/// another order. The paper's factors of Y_{j−1} and Y_{j−2} add up to 1, so a sweep reads no third
/// stage. Inputs: Y_{j−1}, Y_{j−2}.
SweepForm rkl1_form() {
    SweepForm form;
    form.inputs = 2;
    form.base_input = 1;
    form.coefficients = 2;
    form.outputs = {{SweepOutput::Kind::state,
                     {{Source::difference, 0, Weight::coefficient, 0},
                      {Source::rate, 0, Weight::coefficient, 1},
                      {Source::value, 0}}}};
    return form;
}

Scheme rkl1(std::uint32_t stages) {
    const double s = stages, w = 2 / (s * s + s);
    Scheme scheme;
    scheme.registers = registers_of_parts;
    scheme.forms = {first_legendre_form(), rkl1_form()};
    for (std::uint32_t j = 1; j <= stages; ++j) {
        const double n = j;
        Sweep sweep;
        sweep.form = j == 1 ? 0 : 1;
        sweep.time = (n * n - n) / (s * s + s);
        sweep.inputs = {register_of_part(j - 1, stages)};
        sweep.outputs = {register_of_part(j, stages)};
        if (j > 1) {
            sweep.inputs.push_back(register_of_part(j - 2, stages));
            sweep.coefficients.push_back({(n - 1) / n, false});
        }
        sweep.coefficients.push_back({(2 * n - 1) / n * w, true});
        scheme.sweeps.push_back(std::move(sweep));
    }
    return scheme;
}

/// The coefficients of stage j of rkl2, by their names in the paper.
struct LegendreStage {
    double mu = 0, nu = 0, mu_tilde = 0, gamma_tilde = 0;
};

double b(std::uint32_t j) {
    if (j < 2) return 1.0 / 3.0;
    const double n = j;
    return (n * n + n - 2) / (2 * n * (n + 1));
}

LegendreStage rkl2_stage(std::uint32_t j, std::uint32_t stages) {
    const double n = j, s = stages;
    const double w = 4 / (s * s + s - 2);
    LegendreStage stage;
    if (j == 1) {
        stage.mu_tilde = b(1) * w;
        return stage;
    }
    stage.mu = (2 * n - 1) / n * b(j) / b(j - 1);
    stage.nu = -(n - 1) / n * b(j) / b(j - 2);
    stage.mu_tilde = stage.mu * w;
    stage.gamma_tilde = -(1 - b(j - 1)) * stage.mu_tilde;
    return stage;
}

/// The time of stage j, as a fraction of the step.
double rkl2_time(std::uint32_t j, std::uint32_t stages) {
    const double n = j, s = stages;
    if (j == 0) return 0;
    if (j == 1) return b(1) * 4 / (s * s + s - 2);
    return (n * n + n - 2) / (s * s + s - 2);
}

/// Y_j = ((μ (Y_{j−1} − Y₀) + ν (Y_{j−2} − Y₀)) + μ̃ τ L(Y_{j−1}) + γ̃ τ L(Y₀)) + Y₀. This is the
/// paper's sum in another order. Inputs: Y_{j−1}, Y₀, then Y_{j−2} unless it is Y₀, then L(Y₀).
SweepForm rkl2_form(bool second) {
    SweepForm form;
    form.inputs = 2;
    form.base_input = 1;
    std::vector<SweepTerm> terms;
    const auto add = [&](Source source, std::uint32_t input) {
        terms.push_back({source, input, Weight::coefficient, form.coefficients++});
    };
    add(Source::difference, 0);
    if (!second) add(Source::difference, form.inputs++);
    add(Source::rate, 0);
    add(Source::value, form.inputs++);
    terms.push_back({Source::value, 1});
    form.outputs = {{SweepOutput::Kind::state, std::move(terms)}};
    return form;
}

/// Stores L(Y₀) in the register that follows the registers of the stages.
Scheme rkl2(std::uint32_t stages) {
    Scheme scheme;
    scheme.registers = registers_of_parts;
    const RegisterId rates_register = scheme.add_register();
    scheme.forms = {first_legendre_form(), rkl2_form(true), rkl2_form(false)};
    scheme.forms[0].outputs.push_back({SweepOutput::Kind::change, {{Source::rate}}});
    for (std::uint32_t j = 1; j <= stages; ++j) {
        const LegendreStage stage = rkl2_stage(j, stages);
        Sweep sweep;
        sweep.form = std::min(j - 1, 2U);
        sweep.time = rkl2_time(j - 1, stages);
        sweep.inputs = {register_of_part(j - 1, stages)};
        sweep.outputs = {register_of_part(j, stages)};
        if (j > 1) {
            sweep.inputs.push_back(old_register);
            sweep.coefficients.push_back({stage.mu, false});
        }
        if (j > 2) {
            sweep.inputs.push_back(register_of_part(j - 2, stages));
            sweep.coefficients.push_back({stage.nu, false});
        }
        sweep.coefficients.push_back({stage.mu_tilde, true});
        (j == 1 ? sweep.outputs : sweep.inputs).push_back(rates_register);
        if (j > 1) sweep.coefficients.push_back({stage.gamma_tilde, true});
        scheme.sweeps.push_back(std::move(sweep));
    }
    return scheme;
}

Scheme legendre(Solver solver, std::uint32_t stages) {
    CHECK(stages >= least_stages(solver) && stages % 2 == 1, "an odd number of stages");
    if (stages == 1) return euler(false);
    return solver == Solver::rkl1 ? rkl1(stages) : rkl2(stages);
}

}  // namespace

std::size_t Scheme::evaluations() const {
    const auto count = std::count_if(sweeps.begin(), sweeps.end(), [&](const Sweep& sweep) {
        return forms[sweep.form].uses_rates();
    });
    return static_cast<std::size_t>(count) - (rate_registers ? 1 : 0);
}

Scheme make_scheme(Solver solver, std::uint32_t species, bool by_item, std::uint32_t stages) {
    switch (solver) {
        case Solver::euler: return euler(by_item);
        case Solver::symplectic: return symplectic(species, by_item);
        case Solver::rk2: return explicit_runge_kutta(midpoint());
        case Solver::rk4: return explicit_runge_kutta(classical());
        case Solver::rk23: return explicit_runge_kutta(bogacki_shampine());
        case Solver::rk45: return explicit_runge_kutta(dormand_prince());
        case Solver::rkl1:
        case Solver::rkl2: return legendre(solver, stages);
        case Solver::imex: return one_filter(WaveResponse::implicit);
        case Solver::gauss: return one_filter(WaveResponse::exponential);
        case Solver::etdrk4: return etdrk4();
        case Solver::ros2: return ros2();
    }
    CHECK(false, "every solver has a scheme");
}

SweepForm rate_form() {
    SweepForm form;
    form.outputs = {{SweepOutput::Kind::change, {{Source::rate}}}};
    return form;
}

Scheme make_substeps(std::uint32_t count) {
    CHECK(count >= 2, "a step has parts");
    Scheme scheme = euler(false);
    scheme.registers = registers_of_parts;
    scheme.sweeps.clear();
    for (std::uint32_t part = 0; part < count; ++part) {
        Sweep sweep;
        sweep.time = static_cast<double>(part) / count;
        sweep.coefficients = {{1.0 / count, true}};
        sweep.inputs = {register_of_part(part, count)};
        sweep.outputs = {register_of_part(part + 1, count)};
        scheme.sweeps.push_back(std::move(sweep));
    }
    return scheme;
}

}  // namespace cascade
