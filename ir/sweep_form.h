// Sweeps: what one evaluation of a stage's rates writes. A time step is one sweep (explicit Euler)
// or several (Runge-Kutta).
//
// A form determines the code of a kernel. The planes that it reads and writes and the coefficients
// are arguments, so that sweeps of one form share a kernel for every time step. Time integrators
// write forms (solvers/scheme.h), and the lowering reads them (lang/lower/lower.h).
#pragma once

#include "core/id.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

using SpeciesId = Id<struct SpeciesTag>;  ///< Counted from a system's first species.

using TemporaryId = Id<struct TemporaryTag>;  ///< A plane that passes write for later ones.
using AggregateId = Id<struct AggregateTag>;  ///< An aggregate of a plan.

/// A register holds the planes of all species at one moment or intermediate point. The first
/// register holds the old step and the second the new one. The others are scratch.
using RegisterId = Id<struct RegisterTag>;
inline constexpr RegisterId old_register{0}, new_register{1}, first_scratch_register{2};

/// A term of an output, for each species in turn.
struct SweepTerm {
    enum class Source : std::uint8_t {
        value,       ///< The species' own value in an input.
        difference,  ///< The same minus its value in the form's base input. This makes the sum of a
                     ///< scheme's coefficients exact, so that a state without change stays the same
                     ///< to the bit.
        rate,        ///< The species' rate, evaluated at input 0.
        solution,    ///< The species' part of the solution of the form's `equations`.
    };
    enum class Weight : std::uint8_t {
        one,          ///< No factor.
        speed,        ///< The stage's item `speed`, which may vary by cell. Only for rates.
        coefficient,  ///< The uniform `coefficient` of the sweep.
    };
    Source source = Source::value;
    std::uint32_t input = 0;  ///< For values and differences.
    Weight weight = Weight::one;
    std::uint32_t coefficient = 0;

    friend bool operator==(const SweepTerm&, const SweepTerm&) = default;
};

/// The value written into one register: the terms, each rounded, added from left to right.
struct SweepOutput {
    enum class Kind : std::uint8_t {
        state,  ///< Values of species, clamped by bounds. Frozen cells keep theirs.
        /// Rates, increments, errors: 0 if the cell is frozen. A rate that would carry a value
        /// beyond the bound that holds it counts as 0.
        change,
    };
    Kind kind = Kind::state;
    std::vector<SweepTerm> terms;

    friend bool operator==(const SweepOutput&, const SweepOutput&) = default;
};

struct SweepForm {
    /// The number of registers read. Rates are evaluated at input 0, also in neighbouring cells.
    /// Other inputs are read only in the cell itself.
    std::uint32_t inputs = 1;
    /// The input that differences are relative to and whose values frozen cells keep.
    std::uint32_t base_input = 0;
    std::uint32_t coefficients = 0;    ///< The number of coefficients used by the terms.
    std::vector<SweepOutput> outputs;  ///< Result o·S + s is output o of the s-th species written.
    std::vector<SpeciesId> species;    ///< The written species; empty for all.
    /// A value at a bound in input 0 stays there, whatever the terms are, if its rate would carry
    /// it beyond. For terms that mix cells.
    bool holds = false;
    /// A rate that would carry a value beyond the bound that holds it counts as 0 in states, too.
    /// For rates of negative weight, which would lift the value off its bound.
    bool ignores_held_rates = false;

    /// x in (1 − c J) x = Σ terms, a system of equations of the species in each cell. J has the
    /// derivatives of their rates by their values in the cell itself, at input 0. A rate that would
    /// carry a value beyond the bound that holds it counts as 0, and so do its derivatives.
    struct Equations {
        std::vector<SweepTerm> terms;
        std::uint32_t coefficient = 0;  ///< The index of c.

        friend bool operator==(const Equations&, const Equations&) = default;
    };
    std::optional<Equations> equations;

    /// Whether it evaluates the rates, instead of only combining earlier results.
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

/// A rate's wave after a step of length h, in which diffusion changes it at the rate M ≤ 0.
enum class WaveResponse : std::uint8_t {
    implicit,     ///< Times 1 / (1 − h M): diffusion as it is at the step's end.
    exponential,  ///< Times (exp(h M) − 1) / (h M): diffusion solved exactly.
    etd_first,    ///< The stages of etdrk4 (solvers/etd_stages.h).
    etd_second,
    etd_third,
    etd_last,
};

/// The number of registers in which the stages of etdrk4 store waves.
inline constexpr std::size_t etd_registers = 6;

/// Replaces every wave of all species in a register by its response.
struct SweepFilter {
    RegisterId in_register;
    WaveResponse response = WaveResponse::implicit;
    std::vector<RegisterId> kept = {};     ///< For etdrk4.
    std::optional<RegisterId> error = {};  ///< Written by the last stage of etdrk4.
};

/// One sweep of a scheme: a form with its arguments.
struct Sweep {
    std::uint32_t form = 0;             ///< Index of the form in its scheme.
    std::optional<SweepFilter> filter;  ///< Applied before the sweep.
    std::vector<RegisterId> inputs;     ///< Register of each input.
    std::vector<RegisterId> outputs;    ///< Register of each output. May be that of an input read
                                        ///< only in the cell itself.
    /// Species with a lower index are read from the new register wherever input 0 is read.
    std::uint32_t renewed = 0;
    struct Coefficient {
        double value = 0;
        bool times_step = false;  ///< Multiplied by the time step.
    };
    std::vector<Coefficient> coefficients;
    double time = 0;  ///< Rates are evaluated at t + time · (time step).
};

}  // namespace cascade
