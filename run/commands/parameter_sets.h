// The table of `cascade sweep --sets`: a row of numbers for each run, under the names of
// parameters.
#pragma once

#include "core/result.h"
#include "run/commands/variation.h"
#include "run/script/script.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct ParameterSets {
    Variation variation;  ///< All names, which vary together.
    /// By row, the header first, and column: "sets.csv:3:7", for messages.
    std::vector<std::vector<std::string>> places;
};

/// Reads a table of comma-separated values. Its first row has names as for `--set`, or `seed`; the
/// others have a number, or a fraction of two, for each. Fails, with the place in the file, on
/// anything else, on a name or a row that is there twice, and on more than `most_runs` rows.
Result<ParameterSets> read_parameter_sets(const std::filesystem::path& path);

/// The first error of the script of run `number`, where it is in a name or a value of the table.
std::optional<Failure> fault_in(const ParameterSets& sets, const Script& script,
                                std::size_t number);

}  // namespace cascade
