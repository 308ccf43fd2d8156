// Time integrators: how a step is composed of sweeps. A sweep evaluates the rates once in all cells
// (ir/sweep_form.h).
//
// A scheme is data: forms, each of which becomes a kernel, and the sweeps of one step. Coefficients
// are multiplied by the time step only when a step is taken, so the time step may change from step
// to step.
#pragma once

#include "ir/solver.h"
#include "ir/sweep_form.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// Registers of a method whose last rate is the first rate of the next step ("first same as last").
struct RateRegisters {
    RegisterId first, last;

    friend bool operator==(RateRegisters, RateRegisters) = default;
};

/// A rate that a step has stored in a register, and its factor in the curve through the step.
struct CurveRate {
    RegisterId rate;
    double factor = 0;
};

struct Scheme {
    std::uint32_t registers = 2;
    std::vector<SweepForm> forms;
    std::vector<Sweep> sweeps;  ///< In order. One of the last sweeps writes the new step.
    /// An estimate of the step's error, of order order_of() in the length of the step.
    std::optional<RegisterId> error_register;
    /// If set, sweep 0 writes only the first rate, and the last sweep writes the last rate. In a
    /// step that follows another, the two registers are swapped and sweep 0 is left out.
    std::optional<RateRegisters> rate_registers;
    /// A term that raises the order of the curve through a step above the order of Hermite's cubic.
    /// At the fraction θ of the step, the term is θ² (1 − θ)² · step · Σ factor · rate. Empty if
    /// the method has no such term.
    std::vector<CurveRate> curve;

    RegisterId add_register() { return RegisterId(registers++); }
    /// The number of evaluations of the rates in a step that follows another.
    std::size_t evaluations() const;
};

/// Builds the scheme of a solver.
///
/// `species` is the number of species of the system. If `by_item` is true, `euler` and `symplectic`
/// take the length of the step from the stage's setting `speed`, which may vary by cell, instead of
/// from the time loop. `stages` is for stabilised solvers only: an odd number, at least
/// least_stages().
Scheme make_scheme(Solver solver, std::uint32_t species, bool by_item, std::uint32_t stages = 3);

/// A form that writes only the rates at input 0.
SweepForm rate_form();

/// The scheme of explicit Euler steps, each divided into `count` equal parts, at least 2.
Scheme make_substeps(std::uint32_t count);

}  // namespace cascade
