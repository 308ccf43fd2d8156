// Parses the times of options, with or without a unit.
#include "app/option_values.h"
#include "run/commands/variation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Reads a time above 0, with or without a unit, and adds it to times in the same unit.
bool add_time(std::string_view text, GivenTimes& times) {
    const auto time = read_with_unit(text);
    if (!time || !(time->number > 0) || !std::isfinite(time->number)) return false;
    const auto& before = times.numbers;
    if (!before.empty() && (time->number <= before.back() || !times.unit.empty())) return false;
    times.numbers.push_back(time->number);
    times.unit = std::string(time->unit);
    return true;
}

}  // namespace

Result<GivenTimes> parse_time(std::string_view text) {
    GivenTimes time;
    if (add_time(text, time)) return time;
    return failure(fmt::format("'{}' is not a time above 0", text),
                   "write a number in the unit of the script, as in --every 10, or with a unit, as "
                   "in --every '10 min'");
}

Result<GivenTimes> parse_times(std::string_view text) {
    GivenTimes times;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (!add_time(text.substr(begin, end - begin), times)) {
            return failure(fmt::format("'{}' is not a list of times that rise", text),
                           "write them with commas and no spaces, as in --at 1,2,5,10; a unit "
                           "follows the last time, as in --at '1,2,5 min'");
        }
        begin = end + 1;
    }
    return times;
}

}  // namespace cascade
