// The class of a flat state by parameters: critical values of one, a map over two.
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

/// A change of class.
struct CriticalValue {
    double value = 0;
    std::optional<Stability> below, above;  ///< Empty: the flat state does not exist there.
    double cells = 0;                       ///< The fastest wave's length there, or NaN.
    /// At the onset of standing waves, if known (amplitude_equations()).
    std::optional<AmplitudeEquations> amplitudes = {};
    /// The value at which stripes replace spots, by these equations. NaN if they do not.
    double stripes = std::numeric_limits<double>::quiet_NaN();
};

struct ParameterScan {
    ParameterSpan span;
    double present = 0;  ///< Its value in the script.
    std::optional<Stability> at_low, at_high;
    std::vector<CriticalValue> changes;  ///< By increasing value.
};

/// Follows a flat state of the script through about a hundred values of a parameter, and bisects
/// between two of them where its class changes. Fails where linear_model() does.
Result<ParameterScan> scan_parameter(const Program& program, std::uint32_t stage,
                                     const ParameterSpan& span, const Vector& state);

/// The parameters of a stage that have a range and on which its rates depend.
std::vector<ParameterSpan> ranged_parameters(const Program& program, std::uint32_t stage);

struct ParameterMap {
    ParameterSpan across, up;
    std::size_t side = 0;                           ///< The number of values of each parameter.
    std::vector<std::optional<Stability>> classes;  ///< Rows from the lowest value of `up`.
};

/// Classes of a flat state of the script at side × side pairs of values, including the ends of
/// ranges. Blocks of 8 × 8 pairs whose corners are alike count as a whole.
Result<ParameterMap> map_parameters(const Program& program, std::uint32_t stage,
                                    const ParameterSpan& across, const ParameterSpan& up,
                                    std::size_t side, const Vector& state);

}  // namespace cascade::analysis
