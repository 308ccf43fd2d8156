// Time series of a run: `--log EXPR` writes a table with a row every few steps.
#pragma once

#include "core/result.h"
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
    /// Uniform ones, perhaps after "NAME=", or names of features; without any, nothing is logged.
    std::vector<std::string> expressions;
    std::int64_t every = 0;      ///< Steps between rows; 0 for each stage's `interval`.
    std::filesystem::path file;  ///< Empty for a file beside the picture.
};

/// The most rows of a log, which is kept in memory.
inline constexpr std::int64_t most_log_rows = 10'000'000;

/// The rows of one run, in memory until the run ends, even if it diverges. Columns: stage, step, t,
/// and each expression; a cell is empty if its expression has no meaning in the stage.
class RunLog {
public:
    /// Checks the expressions for all stages that run. One that fits none of them, or varies by
    /// cell, is an error in `script.diagnostics`. Features are measured of what `picture` shows.
    static Result<RunLog> create(Script& script, const LogRequest& request,
                                 const PictureRequest& picture);

    /// Steps between two rows of a stage.
    std::int64_t every(const Stage& stage) const {
        return request_.every > 0 ? request_.every : stage.interval;
    }
    /// Adds a row for the present state of a started stage, unless it already has that row.
    void record(const Simulation& simulation, std::uint32_t stage);
    Result<void> write(const std::filesystem::path& path) const;

private:
    struct Row {
        std::uint32_t stage = 0;
        std::int64_t step = 0;
    };
    struct Column {
        std::string name;
        std::optional<std::size_t> feature = {};  ///< Otherwise the next expression.
    };
    static std::vector<Column> columns_of(Script& script, const LogRequest& request,
                                          std::vector<std::string>& expressions);

    LogRequest request_;
    std::vector<std::string> stage_names_;
    std::vector<Column> columns_;
    UniformNumbers numbers_;
    std::optional<Painter> painter_;  ///< With features.
    std::vector<Row> rows_;
    std::vector<double> values_;  ///< Of all rows: t, then the columns.
    Precision precision_ = Precision::single;
};

}  // namespace cascade
