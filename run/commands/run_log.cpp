// Rows are stored as numbers until the table is written. If an expression has no meaning in a
// stage, its cell of the table is empty.
#include "run/commands/run_log.h"

#include "core/file.h"
#include "measure/features.h"
#include "run/commands/named_expression.h"
#include "run/pictures/measured.h"
#include "core/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

Result<void> check_rows(const Script& script, const LogRequest& request) {
    std::int64_t rows = 0;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        const Stage& stage = script.program->stages[k];
        // A stage without an interval gets ten rows.
        const std::int64_t every = request.every > 0 ? request.every : stage.interval;
        // The number of steps is unknown if the stage has a duration, or if the option `every`
        // makes steps end at multiples of a time.
        const bool is_known = !stage.time.has_duration() && !(stage.time.every > 0);
        if (is_known) rows += every > 0 ? stage.iterations / every : 10;
        if (rows <= most_log_rows) continue;
        return failure(fmt::format("the log would have more than {} rows", most_log_rows),
                       "use --log-every with more steps from one row to the next");
    }
    return {};
}

/// The index of the characteristic length, which follows the features.
constexpr std::size_t number_of_length = measure::feature_count;

std::optional<std::size_t> feature_called(std::string_view name) {
    if (name == "length") return number_of_length;
    const auto& names = measure::feature_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

/// Makes a column for each expression. If an item of the script has the name of a feature, the name
/// means the item.
std::vector<RunLog::Column> RunLog::columns_of(Script& script, const LogRequest& request,
                                               std::vector<std::string>& expressions,
                                               Probes& probes) {
    std::vector<Column> columns;
    for (const std::string& text : request.expressions) {
        auto [name, value] = named_expression(text);
        Column column{std::move(name)};
        if (probes.take(script, "--log", value)) {
            column.is_probe = true;
            columns.push_back(std::move(column));
            continue;
        }
        const auto feature = feature_called(value);
        if (feature && !StageFormulas::fits_some(script, "--log", value)) column.feature = feature;
        else expressions.push_back(std::move(value));
        columns.push_back(std::move(column));
    }
    return columns;
}

Result<RunLog> RunLog::create(Script& script, const LogRequest& request,
                              const PictureRequest& picture) {
    RunLog log;
    log.request_ = request;
    log.precision_ = script.program->domain.precision;
    for (const Stage& stage : script.program->stages) log.stage_names_.push_back(stage.name);
    if (auto fits = check_rows(script, request); !fits) return tl::unexpected(fits.error());
    std::vector<std::string> expressions;
    log.columns_ = columns_of(script, request, expressions, log.probes_);
    if (auto good = log.probes_.check(script, "--log"); !good) return tl::unexpected(good.error());
    auto numbers = UniformNumbers::create(script, "--log", expressions);
    if (!numbers) return tl::unexpected(numbers.error());
    log.numbers_ = *std::move(numbers);
    const bool has_features =
        std::any_of(log.columns_.begin(), log.columns_.end(),
                    [](const Column& column) { return column.feature.has_value(); });
    if (!has_features) return log;
    auto painter = Painter::create(script, picture);
    if (!painter) return tl::unexpected(painter.error());
    log.painter_ = *std::move(painter);
    return log;
}

void RunLog::record(const Simulation& simulation, std::uint32_t stage) {
    const std::int64_t step = simulation.state(stage).steps;
    const double t = time_of(simulation, stage);
    if (!rows_.empty() && rows_.back().stage == stage && rows_.back().step == step) {
        const double last = values_[values_.size() - 1 - columns_.size()];
        if (last == t || std::isnan(t)) return;
    }
    rows_.push_back({stage, step});
    values_.push_back(t);
    const std::vector<double> numbers = numbers_.at(simulation, stage);
    std::optional<std::array<double, measure::feature_count>> features;
    const auto feature = [&](std::size_t k) {
        if (k == number_of_length) return shown_length(*painter_, simulation);
        if (!features) features = measure::to_array(measure_shown(*painter_, simulation));
        return (*features)[k];
    };
    const std::vector<double> probed = probes_.at(simulation, stage);
    auto number = numbers.begin(), probe = probed.begin();
    for (const Column& column : columns_) {
        if (column.is_probe) values_.push_back(*probe++);
        else values_.push_back(column.feature ? feature(*column.feature) : *number++);
    }
}

std::string RunLog::table() const {
    std::vector<std::string> cells = {"stage", "step", "t"};
    for (const Column& column : columns_) cells.push_back(column.name);
    std::string table = csv_row(cells);
    const std::size_t width = 1 + columns_.size();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        cells = {stage_names_[rows_[r].stage], fmt::format("{}", rows_[r].step)};
        for (std::size_t k = 0; k < width; ++k) {
            cells.push_back(csv_number(values_[r * width + k], precision_));
        }
        table += csv_row(cells);
    }
    return table;
}

Result<void> RunLog::write(const std::filesystem::path& path) const {
    return write_file(path, table());
}

}  // namespace cascade
