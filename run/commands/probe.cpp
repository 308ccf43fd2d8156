// Places are the coordinates x, y and z of formulas, which go from 0 to 1 along the longest side of
// the domain.
#include "run/commands/probe.h"

#include "core/decimal.h"
#include "run/pictures/picture_size.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace cascade {

namespace {

constexpr std::string_view before_place = " at ";

/// Reads "(0.25, 0.5)" or "0.25, 0.5". Returns no numbers if the text has another form.
std::vector<double> numbers_of_place(std::string_view text) {
    std::vector<double> numbers;
    const std::string_view end_of_place = text.starts_with('(') ? ")" : "";
    text.remove_prefix(end_of_place.size());
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        double number = 0;
        const auto [end, error] = from_decimal(text.data(), text.data() + text.size(), number);
        if (error != std::errc()) return {};
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        if (text == end_of_place) return numbers;
        if (!text.starts_with(',')) return {};
        text.remove_prefix(1);
    }
}

/// Returns the lengths of the axes x, y and z along which places are given. The longest length is
/// 1.
std::vector<double> lengths_of(const Grid& grid) {
    std::vector<std::int64_t> cells = {grid.width};
    if (grid.height * grid.depth > 1) cells.push_back(grid.height);
    if (grid.depth > 1) cells.push_back(grid.depth);
    std::vector<double> lengths;
    for (const std::int64_t count : cells) {
        lengths.push_back(static_cast<double>(count) / static_cast<double>(grid.longest_side()));
    }
    return lengths;
}

bool is_within(const std::vector<double>& place, const std::vector<double>& lengths) {
    return std::equal(place.begin(), place.end(), lengths.begin(), lengths.end(),
                      [](double at, double length) { return at >= 0 && at <= length; });
}

/// Returns the column, row or slice that contains a coordinate of a place.
std::int64_t cell_at(double place, std::int64_t cells, const Grid& grid) {
    const auto longest = static_cast<double>(grid.longest_side());
    const auto cell = static_cast<std::int64_t>(std::floor(place * longest));
    return std::clamp<std::int64_t>(cell, 0, cells - 1);
}

}  // namespace

bool Probes::take(Script& script, const std::string& option, const std::string& text) {
    const std::size_t at = text.rfind(before_place);
    if (at == std::string::npos) return false;
    const std::string_view after = std::string_view(text).substr(at + before_place.size());
    const std::vector<double> numbers = numbers_of_place(after);
    if (numbers.empty() && !after.starts_with('(')) return false;
    const auto refuse = [&](std::string message, std::string hint) {
        script.diagnostics.error(option_span(script.sources, option, text), std::move(message),
                                 std::move(hint));
        is_wrong_ = true;
        return true;
    };
    const DomainSettings& domain = script.program->domain;
    if (domain.model || domain.surface || has_cells(script)) {
        return refuse(
            "a value at a position can be read only from fields on a plane or in a "
            "volume",
            "use --series NAME.h5 for all cells and their positions");
    }
    const std::vector<double> lengths = lengths_of(domain.grid);
    if (!is_within(numbers, lengths)) {
        constexpr std::array names = {"x", "y", "z"};
        std::vector<std::string> ranges, middle;
        for (std::size_t k = 0; k < lengths.size(); ++k) {
            ranges.push_back(fmt::format("{} from 0 to {:.4g}", names[k], lengths[k]));
            middle.push_back(fmt::format("{:.4g}", lengths[k] / 2));
        }
        return refuse(fmt::format("this position is not in the domain, which has {}",
                                  fmt::join(ranges, ", ")),
                      fmt::format("write '{} at ({})' for the cell in the middle",
                                  text.substr(0, at), fmt::join(middle, ", ")));
    }
    std::array<double, 3> place{};
    std::copy(numbers.begin(), numbers.end(), place.begin());
    places_.push_back(place);
    expressions_.push_back(text.substr(0, at));
    return true;
}

Result<void> Probes::check(Script& script, const std::string& option) {
    if (is_wrong_) return failure(fmt::format("a place of {} is wrong", option));
    if (expressions_.empty()) return {};
    auto formulas = StageFormulas::create(script, option, expressions_, FormulaKind::for_a_cell);
    if (!formulas) return tl::unexpected(formulas.error());
    formulas_ = *std::move(formulas);
    return {};
}

std::vector<double> Probes::at(const Simulation& simulation, std::uint32_t stage) const {
    std::vector<double> numbers(places_.size(), std::numeric_limits<double>::quiet_NaN());
    if (places_.empty()) return numbers;
    const Grid& grid = simulation.domain().grid;
    const std::vector<Field> known = simulation.evaluate(formulas_.known_in(stage), stage);
    auto next = known.begin();
    for (std::size_t k = 0; k < places_.size(); ++k) {
        if (formulas_.at(k, stage) == nullptr) continue;
        const auto& [x, y, z] = places_[k];
        numbers[k] =
            (next++)->number_at(cell_at(x, grid.width, grid), cell_at(y, grid.height, grid),
                                cell_at(z, grid.depth, grid));
    }
    return numbers;
}

}  // namespace cascade
