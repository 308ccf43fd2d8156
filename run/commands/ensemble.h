// Ensembles: runs of a sweep that differ only in their seed.
#pragma once

#include "run/commands/statistics.h"
#include "picture/drawing.h"
#include "run/commands/sweep_result.h"
#include "run/commands/variation.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The results of a sweep, in the order of its runs. Missing results are empty.
using SweepResults = std::span<const std::optional<SweepResult>>;

/// Returns the names of the numbers that a sweep measures in each run: the features and, if a
/// result counts crawling cells, `cells`, `births` and `deaths`.
std::vector<std::string> measured_names(SweepResults results);
/// Returns the number of a result that has this name, or NaN if the result is missing or has no
/// such number.
double measured_number(const std::optional<SweepResult>& result, std::string_view name);

/// Whether the seed is varied and has several values.
bool has_ensembles(std::span<const Variation> varied);

struct Ensemble {
    std::vector<std::string> values;  ///< One for each varied name except `seed`.
    std::vector<std::size_t> runs;    ///< The indices of its runs.
};

/// The ensembles of a sweep, in the order of their first runs.
std::vector<Ensemble> ensembles_of(std::size_t runs, std::span<const Variation> varied);
std::vector<std::string> names_but_seed(std::span<const Variation> varied);

/// The columns of statistics in tables of ensembles, which add_cells() fills in.
inline constexpr std::array statistics_header = {"runs", "mean", "deviation", "low", "high"};
void add_cells(std::vector<std::string>& row, const Statistics& all);

/// A table with a row for each combination of the values other than the seed, and for each measured
/// number except `angle`, whose mean would depend on where its circle begins. A row has the
/// combination, the name of the number, and the number's statistics over the runs that have the
/// number.
std::string ensemble_table(SweepResults results, std::span<const Variation> varied);

/// Checks whether draw_curve() can draw a number over the first varied name other than `seed`.
/// Fails if a value of this name is not a number, or if the measured number is unknown.
Result<void> check_curve(std::string_view number, std::span<const Variation> varied);

/// Draws a measured number over the first varied name other than `seed`, with a curve for each
/// combination of the values of the remaining names. Several seeds give the mean with a bar for the
/// 95 % confidence interval. The arguments must have passed check_curve().
Drawing draw_curve(std::string_view number, SweepResults results,
                   std::span<const Variation> varied);

}  // namespace cascade
