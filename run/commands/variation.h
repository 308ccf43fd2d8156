// The variations of a sweep: names with lists of values, and the runs that they define.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// A name and its values, as texts that `--set` accepts. Several names can vary together. The name
/// is then, for example, "(feed, kill)", with values such as "(0.03, 0.06)".
struct Variation {
    /// A name that `--set` accepts, `seed`, or several names in brackets.
    std::string name;
    std::vector<std::string> values;  ///< Contains at least one value.

    friend bool operator==(const Variation&, const Variation&) = default;
};

/// The largest number of runs of a sweep.
inline constexpr std::size_t most_runs = 10000;

/// Parses a variation. "gray_scott.feed=0.02..0.06:9" gives nine equidistant values, the first and
/// last of which are the ends of the range. With ":log" at the end of the text, the ratio of
/// successive values is constant instead. "ka=1/400,1/200" is a list, and "(feed, kill)=(0.03,
/// 0.06), (0.04, 0.06)" a list for two names. The ends of a range are numbers or fractions of two
/// numbers. In "D=1..5 um^2/s:9", all values are in um^2/s. Fails for any other text.
Result<Variation> parse_variation(std::string_view text);

/// Parses seeds: "1..50" gives all whole numbers from 1 to 50, and "3,7" is a list. The result
/// varies `seed`. Fails for any other text.
Result<Variation> parse_seeds(std::string_view text);

/// A name with the ends of its range.
struct VariedRange {
    std::string name;
    double low = 0, high = 1;  ///< low < high.
    /// The unit of the ends. If empty, they are in the unit of the value that they replace.
    std::string unit = {};
};

/// Parses a range that does not give a number of values, such as "gray_scott.feed=0.02..0.06". The
/// ends are numbers or fractions. A unit after the second end is the unit of both.
Result<VariedRange> parse_varied_range(std::string_view text);

/// Writes a variation as a text that parse_variation() accepts. Ranges become lists:
/// "ka=1/400,1/200".
std::string text_of(const Variation& variation);

/// Reads a number or a fraction of two numbers: "0.02", "1/400".
std::optional<double> read_number(std::string_view text);

/// A number or a fraction, and the unit that may follow it after a blank.
struct NumberWithUnit {
    double number = 0;
    std::string unit;  ///< Such as um^2/s or 1/min. Empty if there is none.
};
std::optional<NumberWithUnit> read_with_unit(std::string_view text);

/// Whether a script would read the text as a unit, such as um^2/s or /min.
bool is_unit_text(std::string_view text);

/// A seed: a whole number from 0 to 4294967295. Empty for any other text.
std::optional<std::uint32_t> read_seed(std::string_view text);
/// The hint in messages about texts that are not seeds.
inline constexpr const char* what_seeds_are = "a seed must be a whole number from 0 to 4294967295";

/// Returns the number of runs, which is the number of all combinations of values. Fails if a name
/// is varied twice, if a value is listed twice, or if there are more than `most_runs` runs.
Result<std::size_t> count_runs(std::span<const Variation> varied);

/// Returns all names of the variations. Names that vary together are separate elements.
std::vector<std::string> names_of(std::span<const Variation> varied);

/// Returns the values of the names in run `number`, in the order of names_of(). From run to run,
/// the first variation changes fastest.
std::vector<std::string> values_of_run(std::span<const Variation> varied, std::size_t number);

/// Returns the name of the folder for a run's fields, such as "feed=0.02,kill=0.05". A slash is
/// replaced by '_'.
std::string folder_name(std::span<const Variation> varied, std::span<const std::string> values);

/// Adds the values of a run to `base`. A value of `seed` sets the seed. All other values are
/// appended to `sets`. Fails if a seed is not an integer of 32 bits.
Result<Overrides> overrides_of_run(const Overrides& base, std::span<const Variation> varied,
                                   std::span<const std::string> values);

}  // namespace cascade
