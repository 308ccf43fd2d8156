// The option `--log EXPR` writes a time series: a table with one row for each observed step.
#pragma once

#include "core/result.h"
#include "run/commands/probe.h"
#include "run/commands/uniform_numbers.h"
#include "run/pictures/painter.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct LogRequest {
    /// Names of features, or expressions with the same value in all cells. An expression may have
    /// "NAME=" in front of it. If empty, nothing is logged.
    std::vector<std::string> expressions;
    std::int64_t every = 0;      ///< Steps between rows. 0: the `interval` of each stage.
    std::filesystem::path file;  ///< If empty, the log is a file in the folder of the picture.
};

/// The largest number of rows of a log. All rows are in memory until the run ends.
inline constexpr std::int64_t most_log_rows = 10'000'000;

/// The rows of one run. They stay in memory until the run ends, whether it succeeds or fails. The
/// columns are the stage, the step, the time t, and each expression. A cell of the table is empty
/// if its expression has no meaning in the stage.
class RunLog {
public:
    /// Checks the expressions for all stages that run. An expression that is valid in no stage, or
    /// that varies by cell, is an error in `script.diagnostics`. Features are measured from the
    /// values that `picture` shows.
    static Result<RunLog> create(Script& script, const LogRequest& request,
                                 const PictureRequest& picture);

    /// Steps between two rows of a stage.
    std::int64_t every(const Stage& stage) const {
        return request_.every > 0 ? request_.every : stage.interval;
    }
    /// Adds a row for the present state of a started stage, unless the table already has it.
    void record(const Simulation& simulation, std::uint32_t stage);
    /// The rows so far as comma-separated values, with the names of the columns first.
    std::string table() const;
    Result<void> write(const std::filesystem::path& path) const;

private:
    struct Row {
        std::uint32_t stage = 0;
        std::int64_t step = 0;
    };
    struct Column {
        std::string name;
        /// The feature in this column. If empty, the column shows an expression.
        std::optional<std::size_t> feature = {};
        bool is_probe = false;  ///< Whether the expression of the column is a probe.
    };
    static std::vector<Column> columns_of(Script& script, const LogRequest& request,
                                          std::vector<std::string>& expressions, Probes& probes);

    LogRequest request_;
    std::vector<std::string> stage_names_;
    std::vector<Column> columns_;
    UniformNumbers numbers_;
    Probes probes_;
    /// The painter whose picture is measured. Empty if no column has a feature.
    std::optional<Painter> painter_;
    std::vector<Row> rows_;
    /// The values of all rows. A row has first t, and then one value for each column.
    std::vector<double> values_;
    Precision precision_ = Precision::single;
};

}  // namespace cascade
