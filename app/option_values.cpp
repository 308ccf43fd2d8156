// Numbers are read by from_chars(), which ignores the locale. A number must extend over the whole
// text.
#include "app/option_values.h"

#include "core/file_format.h"
#include "core/near_name.h"
#include "film/film.h"
#include "lang/vocabulary/words_elsewhere.h"
#include "run/pictures/frame_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace cascade {

namespace {

/// Reads a number. Returns false unless the number extends over the whole text.
template <typename Number>
bool read_all(std::string_view text, Number& number) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end;
}

/// Reads two numbers with a comma between them.
bool read_two(std::string_view text, float& first, float& second) {
    const std::size_t comma = text.find(',');
    return comma != std::string_view::npos && read_all(text.substr(0, comma), first) &&
           read_all(text.substr(comma + 1), second);
}

}  // namespace

Result<std::int64_t> parse_whole(std::string_view text, std::int64_t low, std::int64_t high) {
    std::int64_t number = 0;
    if (read_all(text, number) && number >= low && number <= high) return number;
    double value = 0;  // "1e3" is refused, but the hint suggests 1000.
    const bool is_short = read_all(text, value) && value == std::floor(value) &&
                          value >= static_cast<double>(low) &&
                          value <= std::min(static_cast<double>(high), 1e15);
    return failure(fmt::format("'{}' is not a whole number from {} to {}", text, low, high),
                   is_short ? fmt::format("write {:.0f}", value) : "");
}

Result<GridSize> parse_grid(std::string_view text) {
    // A grid that is too large is refused later, with a message about the grid.
    constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();
    std::array<std::int64_t, 3> sides{1, 1, 1};
    std::size_t begin = 0;
    for (std::int64_t& side : sides) {
        const std::size_t cross = std::min(text.find('x', begin), text.size());
        const auto count = parse_whole(text.substr(begin, cross - begin), 0, largest);
        if (!count) break;
        side = *count;
        if (cross == text.size()) return GridSize{sides[0], sides[1], sides[2]};
        begin = cross + 1;
    }
    std::string sizes(text);
    std::erase(sizes, ' ');
    std::ranges::replace_if(
        sizes, [](char c) { return c == ',' || c == '*'; }, 'x');
    if (sizes != text && parse_grid(sizes)) {
        return failure(fmt::format("'{}' is not a grid", text),
                       fmt::format("write --grid {}", sizes));
    }
    return failure(fmt::format("'{}' is not a grid", text),
                   "write columns x rows, as in --grid 256x128, or columns x rows x slices");
}

Result<CellOptions> parse_cells(std::string_view text) {
    CellOptions cells;
    if (text == "faces" || text == "vertices") {
        cells.kind = text == "faces" ? CellKind::faces : CellKind::vertices;
        return cells;
    }
    const auto count = parse_whole(text, 1, 1'000'000'000);
    if (!count) return failure(count.error().message, "or write 'faces' or 'vertices'");
    cells.count = static_cast<std::uint64_t>(*count);
    return cells;
}

Result<Slice> parse_slice(std::string_view text) {
    const std::size_t axis = std::string_view("xyz").find(text.substr(0, 1));
    Slice slice;
    if (text.size() > 2 && text[1] == '=' && axis < 3 && read_all(text.substr(2), slice.place) &&
        makes_sense(slice)) {
        slice.axis = static_cast<Axis>(axis);
        return slice;
    }
    return failure(fmt::format("'{}' is not a slice", text),
                   "write an axis and a position from 0 to 1, as in --slice z=0.5");
}

Result<ValueRange> parse_range(std::string_view text) {
    ValueRange range;
    if (read_two(text, range.low, range.high) && makes_sense(range)) return range;
    return failure(fmt::format("'{}' is not a range", text),
                   "write the values of the palette's two ends, as in --range 0,8");
}

Result<View> parse_view(std::string_view text) {
    View view;
    if (read_two(text, view.azimuth, view.elevation) && makes_sense(view)) return view;
    return failure(fmt::format("'{}' is not a direction to look from", text),
                   "write degrees around (-360 to 360) and above (-89 to 89), as in --view 30,25");
}

/// Reads "3x2", or "3" for both numbers.
std::optional<std::array<std::int64_t, 2>> parse_sides(std::string_view text,
                                                       std::int64_t largest) {
    const std::size_t cross = text.find('x');
    const auto across = parse_whole(text.substr(0, cross), 1, largest);
    const auto down =
        cross == std::string_view::npos ? across : parse_whole(text.substr(cross + 1), 1, largest);
    if (!across || !down) return std::nullopt;
    return std::array{*across, *down};
}

Result<PictureSize> parse_picture_size(std::string_view text) {
    // A picture that is too large is refused later, when the scale is known.
    constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();
    if (const auto sides = parse_sides(text, largest)) return PictureSize{(*sides)[0], (*sides)[1]};
    return failure(fmt::format("'{}' is not the size of a picture", text),
                   "write pixels across x down, as in --size 1920x1080, or one number for both");
}

Result<PictureCopies> parse_copies(std::string_view text) {
    if (const auto sides = parse_sides(text, most_copies)) {
        return PictureCopies{static_cast<int>((*sides)[0]), static_cast<int>((*sides)[1])};
    }
    return failure(fmt::format("'{}' is not a number of copies", text),
                   fmt::format("write copies across x down, each 1 to {}, as in --copies 2x2",
                               most_copies));
}

Result<float> parse_fov(std::string_view text) {
    float degrees = 0;
    if (read_all(text, degrees) && degrees >= 1 && degrees <= 120) return degrees;
    return failure(fmt::format("'{}' is not a field of view", text),
                   "write degrees from 1 to 120, as in --fov 40");
}

Result<double> parse_texels(std::string_view text) {
    double texels = 0;
    if (read_all(text, texels) && texels >= 0.1 && texels <= 100) return texels;
    return failure(fmt::format("'{}' is not a number of texels along a cell", text),
                   "write a number from 0.1 to 100, as in --texels-per-cell 4");
}

Result<Tiling> parse_tiling(std::string_view text) {
    constexpr std::int64_t most = 1000;
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto levels = parse_whole(text.substr(0, comma), 1, most);
    const auto layer = parse_whole(text.substr(std::min(comma + 1, text.size())), 1, most);
    if (!levels || !layer) {
        return failure(fmt::format("'{}' is not a tiling", text),
                       "write LEVELS,LAYER, as in --tiling 4,2");
    }
    return Tiling{static_cast<int>(*levels), *layer};
}

Result<std::string> parse_device(std::string_view text) {
    if (text == "list" || text == "gpu" || text == "cpu" || parse_whole(text, 0, 999)) {
        return std::string(text);
    }
    return failure(fmt::format("'{}' is not a device", text),
                   "write gpu, or a number that 'cascade run --device list' shows");
}

Result<StopAt> parse_stop_at(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    if (colon != std::string_view::npos && colon > 0) {
        const auto step =
            parse_whole(text.substr(colon + 1), 0, std::numeric_limits<std::int64_t>::max());
        if (step) return StopAt{std::string(text.substr(0, colon)), *step};
    }
    return failure(fmt::format("'{}' is not a place to stop at", text),
                   "write STAGE:STEP, as in --stop-at stage2:3000");
}

Result<SweepPart> parse_part(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash != std::string_view::npos) {
        constexpr auto most = static_cast<std::int64_t>(most_runs);
        const auto count = parse_whole(text.substr(slash + 1), 1, most);
        const auto number = parse_whole(text.substr(0, slash), 1, count ? *count : most);
        if (count && number) {
            return SweepPart{static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
        }
    }
    return failure(fmt::format("'{}' is not a part of a sweep", text),
                   "write K/N, as in --part 3/100 for the third of 100 parts");
}

namespace {

struct Unit {
    std::string_view name;
    double size = 1;
};

/// Reads a number with a unit. If the text has no unit, the unit whose name is empty applies.
std::optional<double> read_in_units(std::string_view text, std::span<const Unit> units) {
    const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
    double number = 0;
    if (!read_all(text.substr(0, digits), number)) return std::nullopt;
    for (const Unit& unit : units) {
        if (text.substr(digits) == unit.name) return number * unit.size;
    }
    return std::nullopt;
}

}  // namespace

Result<double> parse_duration(std::string_view text) {
    constexpr std::array units = {Unit{"", 1},     Unit{"s", 1},    Unit{"m", 60},
                                  Unit{"min", 60}, Unit{"h", 3600}, Unit{"d", 86400}};
    constexpr double longest = 3.2e8;
    const auto seconds = read_in_units(text, units);
    if (seconds && *seconds > 0 && *seconds <= longest) return *seconds;
    return failure(fmt::format("'{}' is not a duration", text), "write 90s, 20m, 1.5h or 2d");
}

Result<double> parse_measuring_time(std::string_view text) {
    const auto seconds = parse_duration(text);
    if (seconds && *seconds >= 0.001 && *seconds <= 3600) return *seconds;
    return failure(fmt::format("'{}' is not a time to measure for", text), "0.001 to 3600 seconds");
}

Result<double> parse_frame_rate(std::string_view text) {
    double rate = 0;
    if (read_all(text, rate) && rate >= slowest_film && rate <= fastest_film) return rate;
    return failure(fmt::format("'{}' is not a number of frames in a second", text),
                   fmt::format("{} to {}", slowest_film, fastest_film));
}

Result<double> parse_film_length(std::string_view text) {
    const auto seconds = parse_duration(text);
    if (seconds && *seconds >= 0.1 && *seconds <= 3600) return *seconds;
    return failure(fmt::format("'{}' is not the length of a film", text), "0.1 to 3600 seconds");
}

std::string describe_duration(double seconds) {
    if (seconds >= 3600) return fmt::format("{:.4g} h", seconds / 3600);
    return seconds >= 60 ? fmt::format("{:.4g} min", seconds / 60)
                         : fmt::format("{:.4g} s", seconds);
}

Result<std::uint64_t> parse_size(std::string_view text) {
    constexpr std::array units = {Unit{"", 1},          Unit{"KB", 1e3},        Unit{"MB", 1e6},
                                  Unit{"GB", 1e9},      Unit{"TB", 1e12},       Unit{"KiB", 1024},
                                  Unit{"MiB", 1048576}, Unit{"GiB", 1073741824}};
    const auto bytes = read_in_units(text, units);
    if (bytes && *bytes >= 1e6 && *bytes < 1e18) return static_cast<std::uint64_t>(*bytes);
    return failure(fmt::format("'{}' is not a size of a megabyte or more", text),
                   "write 500MB, 2GB or 1.5GiB");
}

Result<std::vector<std::string>> parse_names(std::string_view text) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (end == begin) {
            return failure(fmt::format("'{}' is not a list of names", text),
                           "write them with commas and no spaces, as in beta,ka");
        }
        names.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return names;
}

Result<std::string> parse_choice(std::string_view text, std::span<const std::string> choices) {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return std::string(text);
    const bool is_precision = std::find(choices.begin(), choices.end(), "double") != choices.end();
    std::string hint(is_precision ? advice_about(text, WordContext::precision) : "");
    const std::string near = hint.empty() ? nearest_name(text, choices) : "";
    if (!near.empty()) hint = fmt::format("did you mean '{}'?", near);
    return failure(fmt::format("'{}' is not one of {}", text, fmt::join(choices, ", ")),
                   std::move(hint));
}

Result<float> parse_bump(std::string_view text) {
    float bump = 0;
    if (read_all(text, bump) && std::abs(bump) <= 1) return bump;
    return failure(fmt::format("'{}' is not a number from -1 to 1", text),
                   "give a fraction of the model's longest side, as in --bump 0.02");
}

Result<std::string> parse_output_path(std::string_view text) {
    if (output_kind(std::filesystem::path(text))) return std::string(text);
    if (is_called_like_a_movie(std::filesystem::path(text))) {
        return failure(fmt::format("'{}' is a film in a format that Cascade cannot write", text),
                       "the endings of films are " + endings_of(FormatKind::film, "and"));
    }
    if (is_of_kind(text, FormatKind::volume)) {
        return failure(
            fmt::format("'{}' is a volume file, but -o can write a volume only as a picture", text),
            fmt::format("use --volume {}", text));
    }
    const std::string ending = lower_ending(std::filesystem::path(text));
    if (ending == ".npy" || ending == ".csv" || ending == ".h5" || ending == ".txt") {
        return failure(fmt::format("'{}' is a file of numbers, but -o writes pictures", text),
                       "--save FOLDER writes each species as .npy, --series NAME.npy, NAME.h5 or "
                       "NAME.csv fields over time, --log EXPR a table of numbers over time");
    }
    return failure(
        fmt::format("'{}' has an ending that Cascade cannot write", text),
        fmt::format("{} is a picture, {} a figure with axes; {} are films; on a model, {} are "
                    "models, {} their cells",
                    endings_of(FormatKind::picture), endings_of(FormatKind::figure, "or"),
                    endings_of(FormatKind::film, "and"), endings_of(FormatKind::model, "and"),
                    endings_of(FormatKind::cells, "and")));
}

Result<std::string> any_text(std::string_view text) {
    if (text.empty()) return failure("it must not be empty");
    return std::string(text);
}

bool has_ending_of_file(const std::filesystem::path& path) {
    static constexpr std::array<std::string_view, 6> not_written = {".jpg",  ".jpeg", ".tif",
                                                                    ".tiff", ".bmp",  ".txt"};
    return find_format(path) != nullptr ||
           std::ranges::find(not_written, lower_ending(path)) != not_written.end();
}

Result<std::string> parse_folder(std::string_view text) {
    const std::filesystem::path path(text);
    if (!has_ending_of_file(path)) return any_text(text);
    return failure(fmt::format("'{}' has the ending of a file, but this option writes a folder",
                               text),
                   fmt::format("write {}, or {}/ for a folder of that name",
                               (path.parent_path() / path.stem()).string(), text));
}

Result<std::string> parse_frames_folder(std::string_view text) {
    const bool is_number = !text.empty() && text.find_first_not_of("0123456789") == text.npos;
    if (!is_number) return std::string(text);
    return failure(fmt::format("the name of a folder is missing before the number '{}'", text),
                   fmt::format("write the name of a folder, such as ./{}; the stage's 'interval' "
                               "sets the number of frames",
                               text));
}

Result<std::string> parse_data_path(std::string_view text) {
    if (std::filesystem::path(text).extension() == ".h5") return std::string(text);
    return failure(fmt::format("'{}' does not end in .h5", text));
}

Result<std::string> parse_path_of(FormatKind kind, std::string_view text) {
    if (is_of_kind(text, kind)) return std::string(text);
    return failure(fmt::format("'{}' does not end in {}", text, endings_of(kind, "or")));
}

}  // namespace cascade
