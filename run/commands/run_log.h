// Time series of a run: `--log EXPR`, a row of numbers every so many steps, written as a table.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

struct LogRequest {
    std::vector<std::string> expressions;  ///< Each the same in all cells; none: no log.
    std::int64_t every = 0;                ///< Steps from row to row; 0: each stage's `interval`.
    std::filesystem::path file;            ///< Empty: beside the picture.
};

/// A log of more rows is refused: it would fill memory.
inline constexpr std::int64_t most_log_rows = 10'000'000;

/// The rows of one run, in memory until the run ends (also where it blows up: then they are wanted
/// most). Columns: stage, step, t, and each expression; where a stage lacks a name that an
/// expression reads, its place is empty.
class RunLog {
public:
    /// Checks the expressions for all stages that run. An expression that fits none of them, or
    /// differs from cell to cell, is a fault in `script.diagnostics`.
    static Result<RunLog> create(Script& script, const LogRequest& request);

    /// Steps between two rows of a stage.
    std::int64_t every(const Stage& stage) const {
        return request_.every > 0 ? request_.every : stage.interval;
    }
    /// Adds a row for the present state of a started stage, unless it has that row already.
    void record(const Simulation& simulation, std::uint32_t stage);
    Result<void> write(const std::filesystem::path& path) const;

private:
    struct Row {
        std::uint32_t stage = 0;
        std::int64_t step = 0;
    };
    bool check_expression(Script& script, const std::string& text);

    LogRequest request_;
    std::vector<std::string> stage_names_;
    std::vector<std::vector<std::optional<Formula>>> formulas_;  ///< Per expression, per stage.
    std::vector<Row> rows_;
    std::vector<double> values_;  ///< Of all rows: t, then the expressions.
    Precision precision_ = Precision::single;
};

}  // namespace cascade
