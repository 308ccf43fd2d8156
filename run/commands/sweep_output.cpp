// The outputs of a sweep: the sheet and the table.
#include "core/check.h"
#include "picture/map.h"
#include "run/commands/csv.h"
#include "run/commands/sweep.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

MapAxis axis_of(const std::vector<Variation>& varied, std::size_t which) {
    if (which < varied.size()) return {varied[which].name, varied[which].values};
    return {"", {""}};
}

/// The upward axis: the second variation, or all but the first one, the second varying fastest.
MapAxis upward_axis(const std::vector<Variation>& varied) {
    if (varied.size() <= 2) return axis_of(varied, 1);
    const std::span<const Variation> others = std::span(varied).subspan(1);
    MapAxis axis;
    std::size_t count = 1;
    for (const Variation& variation : others) {
        axis.name += (axis.name.empty() ? "" : ", ") + variation.name;
        count *= variation.values.size();
    }
    for (std::size_t number = 0; number < count; ++number) {
        axis.values.push_back(fmt::format("{}", fmt::join(values_of_run(others, number), ", ")));
    }
    return axis;
}

/// One range for all tiles, so that they can be compared.
ValueRange range_of_all(const std::vector<std::optional<SweepResult>>& results) {
    Spread all;
    for (const auto& result : results) {
        if (!result || result->failed() || result->tile.is_colour()) continue;
        all.add(spread_of(result->tile.fields[0]));
    }
    return all.count > 0 ? automatic_range(all) : ValueRange{};
}

MapTile tile_of(const std::optional<SweepResult>& result, ValueRange range, const Palette& palette,
                bool has_mask) {
    if (!result) return {Image(), "not run"};
    if (result->failed()) return {Image(), "failed"};
    const std::vector<Field>& fields = result->tile.fields;
    Image image = result->tile.is_colour() ? paint(fields[0], fields[1], fields[2])
                                           : paint(fields[0], range, palette);
    if (has_mask) clear_where_nan(image, fields[0]);
    return {std::move(image), ""};
}

}  // namespace

Image draw_sweep(const std::vector<std::optional<SweepResult>>& results,
                 const std::vector<Variation>& varied, const PictureRequest& picture,
                 bool has_mask) {
    const Palette* palette = find_palette(picture.palette);
    CHECK(palette, "the palette was checked before the first run");
    const ValueRange range = picture.range ? *picture.range : range_of_all(results);
    std::vector<MapTile> tiles;
    for (const auto& result : results) tiles.push_back(tile_of(result, range, *palette, has_mask));
    return make_map(tiles, axis_of(varied, 0), upward_axis(varied));
}

std::string sweep_table(const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied) {
    std::vector<std::string> row;
    for (const Variation& variation : varied) row.push_back(variation.name);
    for (const std::string_view name : measure::feature_names()) row.emplace_back(name);
    const bool has_cells =
        std::ranges::any_of(results, [](const auto& result) { return result && result->cells; });
    if (has_cells) row.insert(row.end(), {"cells", "births", "deaths"});
    row.emplace_back("steps");
    row.emplace_back("remark");
    std::string table = csv_row(row);
    for (std::size_t number = 0; number < results.size(); ++number) {
        row = values_of_run(varied, number);
        const auto& result = results[number];
        const bool measured = result && !result->failed();
        for (std::size_t k = 0; k < measure::feature_count; ++k) {
            row.push_back(measured ? csv_number(measure::to_array(*result->features)[k]) : "");
        }
        if (has_cells) {
            const auto cells = result ? result->cells : std::nullopt;
            const auto add = [&](std::int64_t SweepResult::Cells::*which) {
                row.push_back(cells ? fmt::format("{}", (*cells).*which) : "");
            };
            add(&SweepResult::Cells::count);
            add(&SweepResult::Cells::births);
            add(&SweepResult::Cells::deaths);
        }
        row.push_back(result ? fmt::format("{}", result->steps) : "");
        row.push_back(result ? result->remark : "not run");
        table += csv_row(row);
    }
    return table;
}

}  // namespace cascade
