// How a flat state's class (its Stability) depends on parameters: the critical values of one
// parameter, or a map over two parameters.
#pragma once

#include "analysis/amplitudes.h"
#include "analysis/stage_analysis.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cascade::analysis {

/// A parameter and the range in which it is varied.
struct ParameterSpan {
    ItemId item;
    double low = 0, high = 1;
};

/// A value of a parameter at which the class changes.
struct CriticalValue {
    double value = 0;
    /// The classes below and above the value. Empty where the flat state does not exist.
    std::optional<Stability> below, above;
    double cells = 0;  ///< The length of the fastest wave at this value, or NaN.
    /// At the onset of standing waves, the result of amplitude_equations(), if there is one.
    std::optional<AmplitudeEquations> amplitudes = {};
    /// The value at which stripes replace spots according to `amplitudes`; NaN if stripes never
    /// replace spots.
    double stripes = std::numeric_limits<double>::quiet_NaN();
};

struct ParameterScan {
    ParameterSpan span;
    double present = 0;  ///< The parameter's value in the script.
    std::optional<Stability> at_low, at_high;
    std::vector<CriticalValue> changes;  ///< Ordered by value.
};

/// Follows a flat state of the script through about a hundred values of a parameter. Where its
/// class changes between two of these values, finds the critical value by bisection. Fails if
/// linear_model() fails.
Result<ParameterScan> scan_parameter(const Program& program, std::uint32_t stage,
                                     const ParameterSpan& span, const Vector& state);

/// The parameters of a stage that have a range and on which its rates depend.
std::vector<ParameterSpan> ranged_parameters(const Program& program, std::uint32_t stage);

struct ParameterMap {
    ParameterSpan across, up;
    std::size_t side = 0;  ///< The number of values along each axis.
    /// The classes row by row. The first row has the lowest value of `up`.
    std::vector<std::optional<Stability>> classes;
};

/// The classes of a flat state of the script at side × side pairs of values, including the ends of
/// both ranges. If the corners of a block of 8 × 8 pairs have the same class, the whole block gets
/// this class. Fails if linear_model() fails.
Result<ParameterMap> map_parameters(const Program& program, std::uint32_t stage,
                                    const ParameterSpan& across, const ParameterSpan& up,
                                    std::size_t side, const Vector& state);

}  // namespace cascade::analysis
