// Sweeps: what one evaluation of a stage's rates writes. A time step is one sweep (explicit Euler)
// or several (Runge-Kutta).
//
// A form decides the code of a kernel; which planes it reads and writes and by what it multiplies
// are arguments, so that sweeps of one form share a kernel however long the time step is. Written
// by time integrators (solvers/scheme.h), read by the lowering (lang/lower/lower.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// A summand of an output, for each species in turn.
struct SweepTerm {
    enum class Source : std::uint8_t {
        value,       ///< The species' own value in an input.
        difference,  ///< The same minus its value in the form's base input. So the sum of a
                     ///< scheme's coefficients is exactly what it should be, and a state without
                     ///< change stays as it is to the bit.
        rate,        ///< The species' rate, evaluated at input 0.
    };
    enum class Weight : std::uint8_t {
        one,          ///< Nothing is multiplied.
        speed,        ///< The stage's item `speed`, which may vary by cell. Of rates only.
        coefficient,  ///< The uniform `coefficient` of the sweep.
    };
    Source source = Source::value;
    std::uint32_t input = 0;  ///< Of values and differences.
    Weight weight = Weight::one;
    std::uint32_t coefficient = 0;

    friend bool operator==(const SweepTerm&, const SweepTerm&) = default;
};

/// What is written into one register: the terms, each rounded (weight times source), added from the
/// left.
struct SweepOutput {
    enum class Kind : std::uint8_t {
        state,  ///< Values of species. Invariants clamp them; a frozen cell keeps its value.
        /// Rates, increments, errors: 0 where a cell is frozen. A rate that would carry a value
        /// beyond the bound at which an invariant holds it counts as 0.
        change,
    };
    Kind kind = Kind::state;
    std::vector<SweepTerm> terms;

    friend bool operator==(const SweepOutput&, const SweepOutput&) = default;
};

struct SweepForm {
    /// How many registers are read. Rates are evaluated at input 0 and read neighbours there;
    /// of the others only the own cell is read.
    std::uint32_t inputs = 1;
    /// The input that differences are from and whose values frozen cells keep: the old step, or a
    /// stage.
    std::uint32_t base_input = 0;
    std::uint32_t coefficients = 0;    ///< How many coefficients the terms use.
    std::vector<SweepOutput> outputs;  ///< Result o·S + s is output o of the s-th species written.
    /// Numbers of the species that are written (0 is the system's first); empty for all.
    std::vector<std::uint32_t> species;
    /// A value that stands at a bound in input 0, which its rate there would carry it beyond, stays
    /// at it whatever the terms say. For terms that were mixed with those of other cells.
    bool holds = false;

    /// Does it evaluate the rates, or only put together what was computed before?
    bool uses_rates() const {
        for (const SweepOutput& output : outputs) {
            for (const SweepTerm& term : output.terms) {
                if (term.source == SweepTerm::Source::rate) return true;
            }
        }
        return false;
    }

    friend bool operator==(const SweepForm&, const SweepForm&) = default;
};

/// The planes of all species at one moment or in between are a register. Register 0 is the old
/// step, 1 becomes the new one, further ones are scratch.
inline constexpr std::uint32_t old_register = 0, new_register = 1;

/// What becomes of a wave that diffusion changes at the rate M ≤ 0 in a step of length h.
enum class WaveResponse : std::uint8_t {
    implicit,     ///< 1 / (1 − h M): diffusion as it is at the end of the step.
    exponential,  ///< (exp(h M) − 1) / (h M): diffusion solved exactly.
};

/// Multiplies every wave of all species in a register.
struct SweepFilter {
    std::uint32_t in_register = 0;
    WaveResponse response = WaveResponse::implicit;
    double part = 1;  ///< h is so many time steps.
};

/// One sweep of a scheme: a form with its arguments.
struct Sweep {
    std::uint32_t form = 0;              ///< Number of the form in its scheme.
    std::optional<SweepFilter> filter;   ///< Done before the sweep.
    std::vector<std::uint32_t> inputs;   ///< Register of each input.
    std::vector<std::uint32_t> outputs;  ///< Register of each output, which may be that of an
                                         ///< input that is read in the own cell only.
    /// Species with a number below this are read from register 1 wherever input 0 is read.
    std::uint32_t renewed = 0;
    struct Coefficient {
        double value = 0;
        bool times_step = false;  ///< The uniform is value times the time step, else value alone.
    };
    std::vector<Coefficient> coefficients;
    double time = 0;  ///< Rates are evaluated at t + time · (time step).
};

}  // namespace cascade
