// What a sweep varies: names with lists of values, and the runs that they make.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// One name and its values, as texts that `--set` takes.
struct Variation {
    std::string name;                 ///< As --set has it, or `seed`.
    std::vector<std::string> values;  ///< At least one.

    friend bool operator==(const Variation&, const Variation&) = default;
};

/// More runs than this are refused: nobody looks at so many.
inline constexpr std::size_t most_runs = 10000;

/// "gray_scott.feed=0.02..0.06:9" is nine values at equal distances, both ends among them;
/// "ka=1/400,1/200" are those. The ends of a range are numbers or fractions of two numbers. Fails,
/// with how it is written, on anything else.
Result<Variation> parse_variation(std::string_view text);

/// As parse_variation() reads it: "ka=1/400,1/200".
std::string text_of(const Variation& variation);

/// How many runs the variations make: all values of each with all of the others. Fails where a name
/// is varied twice, a value is listed twice, or the runs are more than `most_runs`.
Result<std::size_t> count_runs(std::span<const Variation> varied);

/// The values of run `number`, one for each variation; the first variation runs fastest.
std::vector<std::string> values_of_run(std::span<const Variation> varied, std::size_t number);

/// `base` with the values of a run; `seed` goes to the seed, all else after the other sets.
/// Fails where a seed is no whole number of 32 bits.
Result<Overrides> overrides_of_run(const Overrides& base, std::span<const Variation> varied,
                                   std::span<const std::string> values);

}  // namespace cascade
