// Writes the outputs of a sweep: the sheet, the table and the film.
#include "core/check.h"
#include "core/file.h"
#include "film/film.h"
#include "picture/caption.h"
#include "picture/map.h"
#include "core/csv.h"
#include "run/commands/ensemble.h"
#include "run/commands/film_crew.h"
#include "run/commands/sweep.h"
#include "run/commands/sweep_logs.h"
#include "run/script/embedded_script.h"
#include "run/stage/stage_state.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

MapAxis axis_of(const std::vector<Variation>& varied, std::size_t which) {
    if (which < varied.size()) return {varied[which].name, varied[which].values};
    return {"", {""}};
}

/// Returns the vertical axis of the sheet, which shows the second variation. If there are more than
/// two variations, the axis shows all combinations of the variations after the first. The second
/// variation then changes fastest.
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

/// Returns the range of the values in all tiles. The tiles share this range, so that they can be
/// compared.
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

/// Writes the values of a run, such as "feed = 0.03  kill = 0.06".
std::string values_as_text(const std::vector<Variation>& varied, std::size_t run) {
    const std::vector<std::string> names = names_of(varied), values = values_of_run(varied, run);
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < names.size(); ++k) {
        parts.push_back(fmt::format("{} = {}", names[k], values[k]));
    }
    return fmt::format("{}", fmt::join(parts, "  "));
}

// Pictures with shorter sides are enlarged to this side, so that captions fit.
constexpr std::int64_t least_film_side = 240;

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

Result<void> film_sweep(const std::filesystem::path& path, const FilmRequest& pace,
                        const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied, const PictureRequest& picture,
                        bool has_mask, const std::atomic<bool>& cancel) {
    const Palette* palette = find_palette(picture.palette);
    CHECK(palette, "the palette was checked before the first run");
    const ValueRange range = picture.range ? *picture.range : range_of_all(results);
    std::vector<std::size_t> runs;
    for (std::size_t run = 0; run < results.size(); ++run) {
        if (results[run] && !results[run]->failed()) runs.push_back(run);
    }
    if (runs.empty()) {
        return failure(fmt::format("'{}' has no frames, because no run has an end", path.string()));
    }
    const auto draw = [&](std::size_t number) -> Result<FilmFrame> {
        Image image = tile_of(results[runs[number]], range, *palette, has_mask).image;
        const std::int64_t side = std::max(image.width, image.height);
        image = enlarge(std::move(image), static_cast<int>((least_film_side + side - 1) / side));
        if (has_room_for_caption(image.width, image.height)) {
            draw_caption(image, values_as_text(varied, runs[number]));
        }
        return film_frame(image);
    };
    FilmSettings settings;
    settings.cancel = &cancel;
    FilmCrew crew({path}, std::move(settings));
    const FilmPlan plan = film_plan(pace, runs.size(), crew.has_gif());
    Result<void> done = crew.begin(plan, draw);
    for (const std::size_t number : plan.frames) {
        auto frame = done.and_then([&] { return draw(number); });
        if (!frame) return tl::unexpected(frame.error());
        done = crew.add(*frame);
    }
    if (!done) return done;
    (void)crew.finish();
    if (crew.failure()) return tl::unexpected(*crew.failure());
    return {};
}

Result<void> check_sweep_film(const SweepRequest& request, const std::atomic<bool>& cancel) {
    const FilmRequest& pace = request.pace;
    const bool has_pace = pace.frames_per_second > 0 || pace.seconds > 0;
    if (request.film.empty()) {
        if (!has_pace) return {};
        return failure("--fps and --seconds need a film, but none is written",
                       "add --film NAME.gif");
    }
    if (auto good = check_writable(request.film); !good) return good;
    if (auto good = check_film(request.film); !good) return good;
    if (auto good = check_pace(request.film, pace.frames_per_second); !good) return good;
    return check_film_size(request.film, request.tile_side, request.tile_side, cancel);
}

Result<std::vector<std::filesystem::path>> write_sweep(
    const Script& script, const SweepRequest& request, const std::filesystem::path& folder,
    const std::vector<std::optional<SweepResult>>& results, const std::atomic<bool>& cancel) {
    const auto sheet = folder / "sheet.png", table = folder / "features.csv";
    const PictureRequest& picture = request.picture;
    std::vector<std::string> varied;
    for (const Variation& variation : request.varied) varied.push_back(text_of(variation));
    const bool has_mask = script.program && script.program->domain.mask;
    std::vector<std::filesystem::path> written = {sheet, table};
    Result<void> done = write_png(sheet, draw_sweep(results, request.varied, picture, has_mask),
                                  picture.png_depth(), embed_sweep(script, picture, varied));
    if (done) done = write_file(table, sweep_table(results, request.varied));
    const auto add_table = [&](const char* name, const std::string& text) {
        if (!done) return;
        written.push_back(folder / name);
        done = write_file(written.back(), text);
    };
    const bool has_logs = !request.log.expressions.empty();
    if (has_logs) add_table("logs.csv", logs_table(results, request.varied));
    if (has_ensembles(request.varied)) {
        add_table("ensembles.csv", ensemble_table(results, request.varied));
        if (has_logs) add_table("log_ensembles.csv", log_ensemble_table(results, request.varied));
    }
    for (const std::string& number : request.curves) {
        if (!done) break;
        written.push_back(folder / (number + ".svg"));
        done = write_drawing(written.back(), draw_curve(number, results, request.varied));
    }
    if (done && !request.film.empty()) {
        done = film_sweep(request.film, request.pace, results, request.varied, picture, has_mask,
                          cancel);
        written.push_back(request.film);
    }
    if (!done) return tl::unexpected(done.error());
    return written;
}

std::string sweep_table(const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied) {
    const std::vector<std::string> measured = measured_names(results);
    std::vector<std::string> row = names_of(varied);
    row.insert(row.end(), measured.begin(), measured.end());
    row.insert(row.end(), {"steps", "remark"});
    std::string table = csv_row(row);
    for (std::size_t number = 0; number < results.size(); ++number) {
        const auto& result = results[number];
        row = values_of_run(varied, number);
        for (const std::string& name : measured) {
            row.push_back(csv_number(measured_number(result, name)));
        }
        row.push_back(result ? fmt::format("{}", result->steps) : "");
        row.push_back(result ? result->remark : "not run");
        table += csv_row(row);
    }
    return table;
}

}  // namespace cascade
