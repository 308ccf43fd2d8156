// Chooses the writer of a film, and checks the limits of its format.
#include "film/film.h"

#include "core/check.h"
#include "core/file_format.h"
#include "core/growing_file.h"
#include "film/ffmpeg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace cascade {
namespace {

struct FilmRow {
    FileFormat format;
    BeginFilm* begin;
    std::int64_t longest_side;
    double fastest = fastest_film;
};

constexpr std::int64_t unlimited = 0x7fffffff;

// The container of WebP allows sides of up to 2^24 pixels, but its pictures only 2^14 - 1. ffmpeg
// checks its own limits.
constexpr std::array films = {
    FilmRow{FileFormat::gif, begin_gif, 65535, fastest_gif},
    FilmRow{FileFormat::webp, begin_webp, 16383},
    FilmRow{FileFormat::apng, begin_apng, unlimited},
    FilmRow{FileFormat::mp4, begin_ffmpeg, unlimited},
    FilmRow{FileFormat::webm, begin_ffmpeg, unlimited},
};
static_assert(has_all_of(films, FormatKind::film));

const FilmRow& film_of(const std::filesystem::path& path) {
    const FormatRow* const format = find_format(path);
    const FilmRow* const row = format ? row_of(films, format->format) : nullptr;
    CHECK(row != nullptr, "the name is that of a film");
    return *row;
}

std::string_view name_of(const std::filesystem::path& path) { return find_format(path)->name; }

Result<void> check_sides(const std::filesystem::path& path, std::int64_t width,
                         std::int64_t height) {
    const std::int64_t longest = film_of(path).longest_side;
    if (width <= longest && height <= longest) return {};
    return failure(fmt::format("'{}' cannot hold frames of {} × {} pixels: a side of {} has at "
                               "most {}",
                               path.string(), width, height, name_of(path), longest),
                   "use a smaller grid or --scale, or write .apng");
}

}  // namespace

Result<void> check_film(const std::filesystem::path& path) {
    if (auto can = check_can_grow(path); !can) return can;
    return film_of(path).begin == begin_ffmpeg ? find_ffmpeg(path) : Result<void>();
}

Result<void> check_pace(const std::filesystem::path& path, double frames_per_second) {
    const double fastest = film_of(path).fastest;
    if (frames_per_second <= fastest) return {};
    return failure(fmt::format("a {} shows at most {} frames a second", name_of(path), fastest),
                   fmt::format(".webp and .apng show up to {}", fastest_film));
}

Result<void> check_film_size(const std::filesystem::path& path, std::int64_t width,
                             std::int64_t height, const std::atomic<bool>& cancel) {
    if (auto fits = check_sides(path, width, height); !fits) return fits;
    if (film_of(path).begin != begin_ffmpeg) return {};
    return try_ffmpeg(path, width, height, cancel);
}

Result<std::unique_ptr<FilmWriter>> begin_film(const std::filesystem::path& path,
                                               const FilmSettings& settings,
                                               std::span<const FilmFrame> samples) {
    CHECK(!samples.empty(), "a film has a frame");
    if (auto fits = check_sides(path, samples[0].width, samples[0].height); !fits) {
        return tl::unexpected(fits.error());
    }
    return film_of(path).begin(path, settings, samples);
}

std::int64_t FrameTimes::next() {
    const auto ends_at = [&](std::int64_t frames) {
        return std::llround(static_cast<double>(frames) * ticks_per_frame_);
    };
    ++frames_;
    return ends_at(frames_) - ends_at(frames_ - 1);
}

}  // namespace cascade
