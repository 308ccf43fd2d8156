// Each cell of the table becomes the text of an option `--set`. If the checker reports an error in
// this text, the message names the cell.
#include "run/commands/parameter_sets.h"

#include "core/counted.h"
#include "core/csv.h"
#include "core/file.h"
#include "core/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

constexpr std::uint64_t largest_table = std::uint64_t{1} << 26;

class SetsReader {
public:
    explicit SetsReader(const std::filesystem::path& path) : file_(printable(path.string())) {}

    Result<ParameterSets> read(const std::string& text) {
        auto rows = read_csv(text);
        if (!rows) {
            return failure(fmt::format("{}:{}", file_, rows.error().message), rows.error().hint);
        }
        if (rows->empty()) return failure(fmt::format("{} has no names in its first line", file_));
        if (auto good = check_names(rows->front()); !good) return tl::unexpected(good.error());
        if (rows->size() == 1) {
            return failure(fmt::format("{} has names but no row of values", file_));
        }
        if (rows->size() - 1 > most_runs) {
            return failure(fmt::format("{} has more than {} rows", file_, most_runs));
        }
        ParameterSets sets;
        for (const auto& row : *rows) {
            if (auto good = check_row(row); !good) return tl::unexpected(good.error());
            std::vector<std::string> texts, places;
            for (const CsvCell& cell : row) {
                texts.push_back(cell.text);
                places.push_back(place(cell));
            }
            sets.places.push_back(std::move(places));
            const std::string joint = fmt::format("({})", fmt::join(texts, ", "));
            if (sets.variation.name.empty()) sets.variation.name = joint;
            else sets.variation.values.push_back(joint);
        }
        return sets;
    }

private:
    std::string place(const CsvCell& cell) const {
        return fmt::format("{}:{}:{}", file_, cell.line, cell.column);
    }
    tl::unexpected<Failure> wrong(const CsvCell& cell, const std::string& why,
                                  const std::string& hint = "") const {
        return failure(fmt::format("{}: {}", place(cell), why), hint);
    }

    Result<void> check_names(const std::vector<CsvCell>& names) {
        for (const CsvCell& name : names) {
            if (name.text.empty()) {
                return wrong(name, "there is no name",
                             "write a name for each column in the "
                             "first line");
            }
            if (name.text.find_first_of(";\t") != std::string::npos) {
                return wrong(name, "the cells of a table must be separated by commas",
                             "write F,k in place of F;k");
            }
            if (name.text.find_first_of("=,()\n") != std::string::npos || read_number(name.text)) {
                return wrong(name, fmt::format("'{}' is not a name", printable(name.text)),
                             "write names as for --set, such as feed or spots.ka");
            }
            if (std::ranges::count(names_, name.text) > 0) {
                return wrong(name, fmt::format("'{}' already has a column", name.text));
            }
            names_.push_back(name.text);
        }
        return {};
    }

    /// Checks a row. The first row that is checked must be the header.
    Result<void> check_row(const std::vector<CsvCell>& row) {
        if (row.size() != names_.size()) {
            return wrong(row.size() < names_.size() ? row.back() : row[names_.size()],
                         fmt::format("this row has {}, but the first line has {}",
                                     counted(static_cast<std::int64_t>(row.size()), "cell"),
                                     names_.size()));
        }
        const bool is_header = std::exchange(is_first_, false);
        if (is_header) return {};
        std::string values;
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (auto good = check_value(row[k], names_[k]); !good) return good;
            values += row[k].text + ",";
        }
        const auto [earlier, is_new] = lines_.emplace(values, row[0].line);
        if (is_new) return {};
        return wrong(row[0], fmt::format("this row repeats line {}", earlier->second));
    }

    Result<void> check_value(const CsvCell& cell, const std::string& name) const {
        if (cell.text.empty()) return wrong(cell, fmt::format("'{}' has no value here", name));
        const auto number = read_number(cell.text);
        if (!number || !std::isfinite(*number)) {
            return wrong(cell, fmt::format("'{}' is not a number", printable(cell.text)),
                         "every cell must be a number such as 0.025, 2e-3 or 1/40");
        }
        if (name != "seed" || read_seed(cell.text)) return {};
        return wrong(cell, fmt::format("'{}' is not a seed", cell.text), what_seeds_are);
    }

    std::string file_;
    std::vector<std::string> names_;
    /// Maps the values of a row to the number of its line.
    std::map<std::string, std::size_t> lines_;
    bool is_first_ = true;
};

}  // namespace

Result<ParameterSets> read_parameter_sets(const std::filesystem::path& path) {
    const auto text = read_file(path, largest_table);
    if (!text) return tl::unexpected(text.error());
    return SetsReader(path).read(*text);
}

std::optional<Failure> fault_in(const ParameterSets& sets, const Script& script,
                                std::size_t number) {
    const std::array all = {sets.variation};
    const std::vector<std::string> names = names_of(all), values = values_of_run(all, number);
    const std::size_t row = 1 + number % sets.variation.values.size();
    for (const Diagnostic& each : script.diagnostics.sorted()) {
        if (each.severity != Severity::error) continue;
        const std::string_view text = script.sources[each.span.source].text();
        for (std::size_t k = 0; k < names.size(); ++k) {
            if (text != fmt::format("{}={}", names[k], values[k])) continue;
            const bool is_in_name = each.span.begin <= names[k].size();
            return Failure{fmt::format("{}: {}", sets.places[is_in_name ? 0 : row][k],
                                       each.message),
                           each.hint};
        }
    }
    return std::nullopt;
}

}  // namespace cascade
