// The kernel with which a device is probed, and its operands: numbers that are difficult to round.
#pragma once

#include "core/grid.h"
#include "core/plane.h"
#include "ir/backend.h"
#include "ir/cell_kernel.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cascade {

template <typename Number>
struct ProbedKernel {
    /// A result for each probed operation on the fields a and b.
    CellKernel kernel;
    /// Words for which inexact devices give wrong results. All pairs of them are operands.
    std::vector<WordOf<Number>> words;
    Grid grid;

    ProbedKernel();
    /// The planes of a and b.
    std::vector<Plane<Number>> arguments() const;
    /// Computes the planes of the results by a compiled form of the kernel.
    std::vector<Plane<Number>> results_of(const Kernel& compiled) const;
    /// Describes the first word of a result that differs; empty if there is none. All NaN count as
    /// equal.
    std::string difference(std::size_t result, const Plane<Number>& expected,
                           const Plane<Number>& found) const;
};

}  // namespace cascade
