// The variations of a sweep: names with lists of values, and the runs that they define.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// A name and its values, as texts that `--set` takes; or names that vary together, "(feed, kill)",
/// with a value for each, "(0.03, 0.06)".
struct Variation {
    std::string name;                 ///< A name as for --set, or `seed`, or several in brackets.
    std::vector<std::string> values;  ///< At least one.

    friend bool operator==(const Variation&, const Variation&) = default;
};

/// The most runs of a sweep.
inline constexpr std::size_t most_runs = 10000;

/// "gray_scott.feed=0.02..0.06:9" is nine equidistant values including both ends; with ":log" after
/// it each is the same multiple of the one before; "ka=1/400,1/200" is a list, and
/// "(feed, kill)=(0.03, 0.06), (0.04, 0.06)" one of two names. The ends of a range are numbers or
/// fractions of two numbers. Fails on anything else.
Result<Variation> parse_variation(std::string_view text);

/// A name and the ends of its range.
struct VariedRange {
    std::string name;
    double low = 0, high = 1;  ///< low < high.
};

/// "gray_scott.feed=0.02..0.06", without a number of values. The ends are numbers or fractions.
Result<VariedRange> parse_varied_range(std::string_view text);

/// The inverse of parse_variation(), with a list: "ka=1/400,1/200".
std::string text_of(const Variation& variation);

/// A number or a fraction of two numbers: "0.02", "1/400".
std::optional<double> read_number(std::string_view text);

/// The number of runs: all combinations of values. Fails if a name is varied twice, a value is
/// listed twice, or there are more than `most_runs`.
Result<std::size_t> count_runs(std::span<const Variation> varied);

/// All names, those that vary together apart.
std::vector<std::string> names_of(std::span<const Variation> varied);

/// The values of run `number`, one for each name; the first variation varies fastest.
std::vector<std::string> values_of_run(std::span<const Variation> varied, std::size_t number);

/// The folder of a run's fields, "feed=0.02,kill=0.05"; a slash becomes '_'.
std::string folder_name(std::span<const Variation> varied, std::span<const std::string> values);

/// `base` with the values of a run; `seed` sets the seed, all others are appended to the sets.
/// Fails if a seed is not a whole number of 32 bits.
Result<Overrides> overrides_of_run(const Overrides& base, std::span<const Variation> varied,
                                   std::span<const std::string> values);

}  // namespace cascade
