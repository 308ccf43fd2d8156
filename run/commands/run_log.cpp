// Rows are numbers until the table is written; a number without a meaning is an empty cell.
#include "run/commands/run_log.h"

#include "core/file.h"
#include "core/csv.h"

#include <fmt/format.h>

namespace cascade {

namespace {

Result<void> check_rows(const Script& script, const LogRequest& request) {
    std::int64_t rows = 0;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        const Stage& stage = script.program->stages[k];
        // A stage without an interval is logged ten times.
        const std::int64_t every = request.every > 0 ? request.every : stage.interval;
        // The number of steps of a duration is not known in advance.
        const bool is_known = !stage.time.duration && !stage.time.duration_in_steps;
        if (is_known) rows += every > 0 ? stage.iterations / every : 10;
        if (rows <= most_log_rows) continue;
        return failure(fmt::format("the log would have more than {} rows", most_log_rows),
                       "let more steps pass between them, with --log-every");
    }
    return {};
}

}  // namespace

Result<RunLog> RunLog::create(Script& script, const LogRequest& request) {
    RunLog log;
    log.request_ = request;
    log.precision_ = script.program->domain.precision;
    for (const Stage& stage : script.program->stages) log.stage_names_.push_back(stage.name);
    if (auto fits = check_rows(script, request); !fits) return tl::unexpected(fits.error());
    auto numbers = UniformNumbers::create(script, "--log", request.expressions);
    if (!numbers) return tl::unexpected(numbers.error());
    log.numbers_ = *std::move(numbers);
    return log;
}

void RunLog::record(const Simulation& simulation, std::uint32_t stage) {
    const std::int64_t step = simulation.state(stage).steps;
    if (!rows_.empty() && rows_.back().stage == stage && rows_.back().step == step) return;
    rows_.push_back({stage, step});
    values_.push_back(time_of(simulation, stage));
    const std::vector<double> numbers = numbers_.at(simulation, stage);
    values_.insert(values_.end(), numbers.begin(), numbers.end());
}

Result<void> RunLog::write(const std::filesystem::path& path) const {
    std::vector<std::string> cells = {"stage", "step", "t"};
    cells.insert(cells.end(), request_.expressions.begin(), request_.expressions.end());
    std::string table = csv_row(cells);
    const std::size_t width = 1 + numbers_.count();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        cells = {stage_names_[rows_[r].stage], fmt::format("{}", rows_[r].step)};
        for (std::size_t k = 0; k < width; ++k) {
            cells.push_back(csv_number(values_[r * width + k], precision_));
        }
        table += csv_row(cells);
    }
    return write_file(path, table);
}

}  // namespace cascade
