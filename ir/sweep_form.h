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

/// Species are counted from the first species of a system.
using SpeciesId = Id<struct SpeciesTag>;

/// A plane that one pass writes and later passes read.
using TemporaryId = Id<struct TemporaryTag>;
using AggregateId = Id<struct AggregateTag>;  ///< An aggregate of a plan.

/// A register is a set of planes, one for each species. A register holds the values at one moment,
/// or at an intermediate stage of a step. The first register holds the old step and the second the
/// new one. All other registers hold intermediate results.
using RegisterId = Id<struct RegisterTag>;
inline constexpr RegisterId old_register{0}, new_register{1}, first_scratch_register{2};

/// One term of an output. An output is a sum of terms, which is evaluated for each species.
struct SweepTerm {
    enum class Source : std::uint8_t {
        value,  ///< The species' value in the register `input`.
        /// The species' value in the register `input`, minus its value in the form's base input.
        /// The coefficients of a scheme then add up exactly, so a state that does not change stays
        /// the same to the bit.
        difference,
        rate,      ///< The species' rate, evaluated at input 0.
        solution,  ///< The species' part of the solution of the form's `equations`.
    };
    enum class Weight : std::uint8_t {
        one,          ///< No factor.
        speed,        ///< The stage's setting `speed`, which may vary by cell. Only for rates.
        coefficient,  ///< The uniform of the sweep that `coefficient` selects.
    };
    Source source = Source::value;
    std::uint32_t input = 0;  ///< The input that a term of kind `value` or `difference` reads.
    Weight weight = Weight::one;
    std::uint32_t coefficient = 0;

    friend bool operator==(const SweepTerm&, const SweepTerm&) = default;
};

/// The sum that is written into one register. The terms are rounded and added from left to right.
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
    /// The input whose values `difference` terms subtract and frozen cells keep.
    std::uint32_t base_input = 0;
    std::uint32_t coefficients = 0;  ///< The number of coefficients used by the terms.
    /// The kernel has S results for each output, one for each written species. Result o·S + s is
    /// output o of written species s.
    std::vector<SweepOutput> outputs;
    /// The species that are written. An empty list means all species.
    std::vector<SpeciesId> species;
    /// Whether a value that is at a bound in input 0 and whose rate points beyond the bound stays
    /// at the bound, regardless of the terms. Needed if terms mix values of several cells.
    bool holds = false;
    /// Whether rates that point beyond a bound also count as 0 in outputs of kind `state`, if the
    /// value is at this bound. Needed for rates of negative weight, which would otherwise move the
    /// value off its bound.
    bool ignores_held_rates = false;

    /// A system of equations for each cell, (1 − c J) x = Σ terms, with an unknown x for each
    /// species. J contains the derivatives of the rates with respect to the values in the cell
    /// itself, at input 0. If a value is at a bound and its rate points beyond the bound, the rate
    /// and its derivatives count as 0.
    struct Equations {
        std::vector<SweepTerm> terms;
        std::uint32_t coefficient = 0;  ///< The index of c among the coefficients of the sweep.

        friend bool operator==(const Equations&, const Equations&) = default;
    };
    std::optional<Equations> equations;

    /// Whether the form evaluates the rates. A form that does not only combines earlier results.
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
    /// The first of the stages of etdrk4 (solvers/etd_stages.h). The following responses are its
    /// other stages.
    etd_first,
    etd_second,
    etd_third,
    etd_last,
};

/// The number of registers in which the stages of etdrk4 store waves.
inline constexpr std::size_t etd_registers = 6;

/// Multiplies every wave of all species in a register by the wave's response.
struct SweepFilter {
    RegisterId in_register;
    WaveResponse response = WaveResponse::implicit;
    std::vector<RegisterId> kept = {};  ///< For etdrk4: the registers that store waves.
    /// The register that the last stage of etdrk4 writes the error to.
    std::optional<RegisterId> error = {};
};

/// One sweep of a scheme: a form with its arguments.
struct Sweep {
    std::uint32_t form = 0;             ///< The index of the form in its scheme.
    std::optional<SweepFilter> filter;  ///< The filter to apply before the sweep.
    std::vector<RegisterId> inputs;     ///< The register of each input.
    /// The register of each output. An output may be the register of an input, if that input is
    /// read only in the cell itself.
    std::vector<RegisterId> outputs;
    /// The species with an index below this number are read from the new register, not from input
    /// 0.
    std::uint32_t renewed = 0;
    struct Coefficient {
        double value = 0;
        bool times_step = false;  ///< Whether `value` is multiplied by the time step.
    };
    std::vector<Coefficient> coefficients;
    double time = 0;  ///< Rates are evaluated at (time of the step) + time · (step length).
};

}  // namespace cascade
