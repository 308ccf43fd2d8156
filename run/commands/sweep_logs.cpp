// Rows of different runs belong together if they have the same stage and time. If the steps of a
// stage have no common time, rows belong together if they have the same step.
#include "run/commands/sweep_logs.h"

#include "core/csv.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace cascade {

namespace {

constexpr std::size_t stage_column = 0, step_column = 1, t_column = 2, first_number = 3;

using LogRow = std::vector<std::string>;

/// The rows of a log, the names of its columns first. Empty if the run has no log.
std::vector<LogRow> rows_of_log(const std::optional<SweepResult>& result) {
    std::vector<LogRow> rows;
    if (!result) return rows;
    const auto table = read_csv(result->log);
    if (!table) return rows;
    for (const auto& cells : *table) {
        LogRow& row = rows.emplace_back();
        for (const CsvCell& cell : cells) row.push_back(cell.text);
    }
    return rows;
}

/// The numbers of several runs at one time.
struct LoggedMoment {
    std::string step, t;
    std::size_t last_run = 0;
    std::vector<std::vector<double>> numbers;  ///< By column, one for each run.
};

/// The logs of an ensemble, by the number of the stage and the time in it.
class EnsembleLog {
public:
    void add(std::size_t run, const LogRow& row) {
        const auto stage = std::ranges::find(stages_, row[stage_column]);
        const std::pair key(stage - stages_.begin(), place_of(row));
        if (stage == stages_.end()) stages_.push_back(row[stage_column]);
        const auto [at, is_new] = moments_.try_emplace(key);
        LoggedMoment& moment = at->second;
        if (is_new) {
            moment = {row[step_column], row[t_column], run, {}};
            moment.numbers.resize(row.size() - first_number);
        } else if (moment.last_run == run) {
            return;
        }
        if (moment.step != row[step_column]) moment.step.clear();
        moment.last_run = run;
        for (std::size_t k = 0; k < moment.numbers.size(); ++k) {
            const auto number = read_number(row[first_number + k]);
            if (number) moment.numbers[k].push_back(*number);
        }
    }

    /// Adds the rows to a table, each beginning with the values of the ensemble.
    void write(const LogRow& values, const LogRow& columns, std::string& table) const {
        for (const auto& [key, moment] : moments_) {
            for (std::size_t k = 0; k < moment.numbers.size(); ++k) {
                LogRow row = values;
                row.insert(row.end(), {stages_[static_cast<std::size_t>(key.first)], moment.step,
                                       moment.t, columns[first_number + k]});
                add_cells(row, statistics_of(moment.numbers[k]));
                table += csv_row(row);
            }
        }
    }

private:
    static double place_of(const LogRow& row) {
        const std::string& text = row[t_column].empty() ? row[step_column] : row[t_column];
        return read_number(text).value_or(std::numeric_limits<double>::infinity());
    }

    std::vector<std::string> stages_;  ///< In the order in which runs take them.
    std::map<std::pair<std::ptrdiff_t, double>, LoggedMoment> moments_;
};

}  // namespace

std::string logs_table(SweepResults results, std::span<const Variation> varied) {
    std::string table;
    for (std::size_t run = 0; run < results.size(); ++run) {
        const std::vector<LogRow> rows = rows_of_log(results[run]);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (k == 0 && !table.empty()) continue;
            LogRow row = k == 0 ? names_of(varied) : values_of_run(varied, run);
            row.insert(row.end(), rows[k].begin(), rows[k].end());
            table += csv_row(row);
        }
    }
    return table;
}

std::string log_ensemble_table(SweepResults results, std::span<const Variation> varied) {
    LogRow header = names_but_seed(varied);
    header.insert(header.end(), {"stage", "step", "t", "number"});
    header.insert(header.end(), statistics_header.begin(), statistics_header.end());
    std::string table = csv_row(header);
    for (const Ensemble& each : ensembles_of(results.size(), varied)) {
        EnsembleLog log;
        LogRow columns;
        for (const std::size_t run : each.runs) {
            if (!results[run] || results[run]->failed()) continue;
            const std::vector<LogRow> rows = rows_of_log(results[run]);
            if (rows.empty()) continue;
            columns = rows[0];
            for (std::size_t k = 1; k < rows.size(); ++k) log.add(run, rows[k]);
        }
        log.write(each.values, columns, table);
    }
    return table;
}

}  // namespace cascade
