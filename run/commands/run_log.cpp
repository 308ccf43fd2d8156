// Each expression is checked against every stage; where it has no meaning its cells stay empty.
#include "run/commands/run_log.h"

#include "core/file.h"
#include "lang/check/check.h"
#include "lang/lower/lower.h"
#include "lang/syntax/parse.h"
#include "run/commands/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

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
    bool right = true;
    for (const std::string& text : request.expressions) {
        right = log.check_expression(script, text) && right;
    }
    if (!right) return failure("an expression of --log is wrong");
    return log;
}

bool RunLog::check_expression(Script& script, const std::string& text) {
    const SourceId source = script.sources.add("<--log>", text);
    const auto expression =
        parse_expression(source, script.sources, script.tree, script.diagnostics);
    if (!expression) return false;
    std::vector<std::optional<Formula>> formulas;
    bool fits_some = false;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        Diagnostics unspoken;
        auto formula =
            check_view(script.tree, *expression, k, k, *script.program, script.sources, unspoken);
        if (unspoken.has_errors()) formula.reset();
        if (formula && formula->nodes.back().type != ValueType::number) {
            script.diagnostics.error(formula->nodes.back().span, "--log takes numbers");
            return false;
        }
        if (formula && !plan_view(*script.program, *formula, k).is_uniform) {
            script.diagnostics.error(
                formula->nodes.back().span, "this differs from cell to cell",
                "a log takes one number for all cells, such as mean(e over domain)");
            return false;
        }
        fits_some = fits_some || formula;
        formulas.push_back(std::move(formula));
    }
    if (!fits_some) {
        // The message is that of the last stage, as for --show.
        const std::uint32_t stage = script.final_stage();
        check_view(script.tree, *expression, stage, stage, *script.program, script.sources,
                   script.diagnostics);
        return false;
    }
    formulas_.push_back(std::move(formulas));
    return true;
}

void RunLog::record(const Simulation& simulation, std::uint32_t stage) {
    const std::int64_t step = simulation.state(stage).steps;
    if (!rows_.empty() && rows_.back().stage == stage && rows_.back().step == step) return;
    rows_.push_back({stage, step});
    values_.push_back(time_of(simulation, stage));
    std::vector<const Formula*> here;
    for (const auto& formulas : formulas_) {
        if (formulas[stage]) here.push_back(&*formulas[stage]);
    }
    const std::vector<double> numbers = evaluate_numbers(simulation, here, stage);
    auto number = numbers.begin();
    for (const auto& formulas : formulas_) {
        values_.push_back(formulas[stage] ? *number++ : none);
    }
}

Result<void> RunLog::write(const std::filesystem::path& path) const {
    std::vector<std::string> cells = {"stage", "step", "t"};
    cells.insert(cells.end(), request_.expressions.begin(), request_.expressions.end());
    std::string table = csv_row(cells);
    const std::size_t width = 1 + formulas_.size();
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
