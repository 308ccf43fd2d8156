// Sweeps. A sweep evaluates the rates of a stage once and writes combinations of them with earlier
// values. A time step is one sweep (explicit Euler) or several (Runge-Kutta).
//
// A form is the part of a sweep that determines the code of its kernel. The planes that the kernel
// reads and writes, and its coefficients, are arguments. So all sweeps of the same form share a
// kernel, even if their time steps differ. Time integrators write forms (solvers/scheme.h), and
// lang/lower/lower.h turns them into kernels.
#pragma once

#include "core/id.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

using SpeciesId = Id<struct SpeciesTag>;  ///< Counted from a system's first species.

using TemporaryId = Id<struct TemporaryTag>;  ///< A plane that one pass writes and later passes
                                              ///< read.
using AggregateId = Id<struct AggregateTag>;  ///< An aggregate of a plan.

/// A register is a set of planes, one for each species. It holds the values at one moment, or at
/// an intermediate point of a step. The first register holds the old step and the second the new
/// one. The other registers are scratch.
using RegisterId = Id<struct RegisterTag>;
inline constexpr RegisterId old_register{0}, new_register{1}, first_scratch_register{2};

/// One term of an output, which is a sum. The term is evaluated for each species.
struct SweepTerm {
    enum class Source : std::uint8_t {
        value,       ///< The species' own value in an input.
        difference,  ///< The species' value in the input, minus its value in the form's base input.
                     ///< The sum of a scheme's coefficients is then exact, so a state without
                     ///< change stays the same to the bit.
        rate,        ///< The species' rate, evaluated at input 0.
        solution,    ///< The species' part of the solution of the form's `equations`.
    };
    enum class Weight : std::uint8_t {
        one,          ///< No factor.
        speed,        ///< The stage's setting `speed`, which may vary by cell. Only for rates.
        coefficient,  ///< The uniform `coefficient` of the sweep.
    };
    Source source = Source::value;
    std::uint32_t input = 0;  ///< The input that a value or difference reads.
    Weight weight = Weight::one;
    std::uint32_t coefficient = 0;

    friend bool operator==(const SweepTerm&, const SweepTerm&) = default;
};

/// The sum written into one register. The terms are rounded and added from left to right.
struct SweepOutput {
    enum class Kind : std::uint8_t {
        state,  ///< Values of species, clamped to their bounds. Frozen cells keep their values.
        /// Rates, increments or errors. Frozen cells get 0. If a value is at a bound and its rate
        /// points beyond this bound, the rate counts as 0.
        change,
    };
    Kind kind = Kind::state;
    std::vector<SweepTerm> terms;

    friend bool operator==(const SweepOutput&, const SweepOutput&) = default;
};

struct SweepForm {
    /// The number of registers that are read. Rates are evaluated at input 0, also in neighbouring
    /// cells. Other inputs are read only in the cell itself.
    std::uint32_t inputs = 1;
    /// The input that differences subtract. Frozen cells keep its values.
    std::uint32_t base_input = 0;
    std::uint32_t coefficients = 0;    ///< The number of coefficients used by the terms.
    std::vector<SweepOutput> outputs;  ///< Result o·S + s of the kernel is output o of the s-th of
                                       ///< S written species.
    std::vector<SpeciesId> species;    ///< The written species; empty for all.
    /// If true, a value that is at a bound in input 0 and whose rate points beyond the bound stays
    /// at the bound, regardless of the terms. Needed if terms mix values of several cells.
    bool holds = false;
    /// If true, a rate that points beyond the bound at which its value is counts as 0 in outputs of
    /// kind `state`, too. Needed for rates of negative weight, which would otherwise move the value
    /// off its bound.
    bool ignores_held_rates = false;

    /// A system of equations for each cell, (1 − c J) x = Σ terms, with an unknown x for each
    /// species. J contains the derivatives of the rates with respect to the values in the cell
    /// itself, at input 0. If a value is at a bound and its rate points beyond the bound, rate and
    /// derivatives count as 0.
    struct Equations {
        std::vector<SweepTerm> terms;
        std::uint32_t coefficient = 0;  ///< The index of c among the coefficients of the sweep.

        friend bool operator==(const Equations&, const Equations&) = default;
    };
    std::optional<Equations> equations;

    /// Whether the form evaluates the rates, instead of only combining earlier results.
    bool uses_rates() const {
        if (equations) return true;
        for (const SweepOutput& output : outputs) {
            for (const SweepTerm& term : output.terms) {
                if (term.source == SweepTerm::Source::rate) return true;
            }
        }
        return false;
    }

    friend bool operator==(const SweepForm&, const SweepForm&) = default;
};

/// The effect of diffusion over a step of length h on a wave of a rate. By diffusion alone, the
/// time derivative of a wave w would be M w with M ≤ 0.
enum class WaveResponse : std::uint8_t {
    implicit,     ///< Factor 1 / (1 − h M): diffusion is taken at the end of the step.
    exponential,  ///< Factor (exp(h M) − 1) / (h M): diffusion is solved exactly.
    etd_first,    ///< This response and the following are stages of etdrk4 (solvers/etd_stages.h).
    etd_second,
    etd_third,
    etd_last,
};

/// The number of registers in which the stages of etdrk4 store waves.
inline constexpr std::size_t etd_registers = 6;

/// Multiplies every wave of all species in a register by its response.
struct SweepFilter {
    RegisterId in_register;
    WaveResponse response = WaveResponse::implicit;
    std::vector<RegisterId> kept = {};     ///< For etdrk4: the registers that store waves.
    std::optional<RegisterId> error = {};  ///< Written by the last stage of etdrk4.
};

/// One sweep of a scheme: a form with its arguments.
struct Sweep {
    std::uint32_t form = 0;             ///< The index of the form in its scheme.
    std::optional<SweepFilter> filter;  ///< Applied before the sweep.
    std::vector<RegisterId> inputs;     ///< The register of each input.
    std::vector<RegisterId> outputs;    ///< The register of each output. It may be the register of
                                        ///< an input that is read only in the cell itself.
    /// Species below this index are read from the new register instead of input 0.
    std::uint32_t renewed = 0;
    struct Coefficient {
        double value = 0;
        bool times_step = false;  ///< Multiplied by the time step.
    };
    std::vector<Coefficient> coefficients;
    double time = 0;  ///< Rates are evaluated at (time of the step) + time · (step length).
};

}  // namespace cascade
