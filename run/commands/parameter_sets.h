// The table of `cascade sweep --sets`. Its header has names of parameters, and each other row has
// the numbers of one run.
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
    Variation variation;  ///< All names of the table. They vary together.
    /// Contains for each cell of the table, by row (the header first) and column, its position in
    /// the file for messages, such as "sets.csv:3:7".
    std::vector<std::vector<std::string>> places;
};

/// Reads a table of comma-separated values. Its first row has names as for `--set`, or `seed`.
/// Every other row has a number, or a fraction of two numbers, for each name. Fails with the
/// position in the file if a cell contains anything else, if a name or a row occurs twice, or if
/// there are more than `most_runs` rows.
Result<ParameterSets> read_parameter_sets(const std::filesystem::path& path);

/// Returns the first error in the script of run `number` that a name or a value of the table has
/// caused.
std::optional<Failure> fault_in(const ParameterSets& sets, const Script& script,
                                std::size_t number);

}  // namespace cascade
