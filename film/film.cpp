// Chooses the writer of a film, and checks what its format can hold.
#include "film/film.h"

#include "core/check.h"
#include "core/file_ending.h"
#include "core/growing_file.h"
#include "film/ffmpeg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace cascade {
namespace {

struct FormatOf {
    std::string_view ending;
    FilmFormat format;
    std::string_view name;
    std::int64_t longest_side;
};

constexpr std::int64_t unlimited = 0x7fffffff;

// WebP's container has sides of up to 2^24 pixels, the pictures in it of 2^14 - 1. ffmpeg knows its
// own limits.
constexpr std::array formats = {
    FormatOf{".gif", FilmFormat::gif, "GIF", 65535},
    FormatOf{".webp", FilmFormat::webp, "WebP", 16383},
    FormatOf{".apng", FilmFormat::apng, "APNG", unlimited},
    FormatOf{".mp4", FilmFormat::mp4, "MP4", unlimited},
    FormatOf{".webm", FilmFormat::webm, "WebM", unlimited},
};

const FormatOf* format_of(const std::filesystem::path& path) {
    const std::string ending = lower_ending(path);
    const auto found = std::find_if(formats.begin(), formats.end(), [&](const FormatOf& format) {
        return format.ending == ending;
    });
    return found == formats.end() ? nullptr : found;
}

bool needs_ffmpeg(FilmFormat format) {
    return format == FilmFormat::mp4 || format == FilmFormat::webm;
}

Result<void> check_sides(const std::filesystem::path& path, const FormatOf& format,
                         std::int64_t width, std::int64_t height) {
    if (width <= format.longest_side && height <= format.longest_side) return {};
    return failure(fmt::format("'{}' cannot hold frames of {} × {} pixels: a side of {} has at "
                               "most {}",
                               path.string(), width, height, format.name, format.longest_side),
                   "use a smaller grid or --scale, or write .apng");
}

}  // namespace

std::optional<FilmFormat> film_format(const std::filesystem::path& path) {
    if (const FormatOf* format = format_of(path)) return format->format;
    return std::nullopt;
}

Result<void> check_film(const std::filesystem::path& path) {
    if (auto can = check_can_grow(path); !can) return can;
    return needs_ffmpeg(*film_format(path)) ? find_ffmpeg(path) : Result<void>();
}

Result<void> check_pace(const std::filesystem::path& path, double frames_per_second) {
    if (film_format(path) != FilmFormat::gif || frames_per_second <= fastest_gif) return {};
    return failure(fmt::format("a GIF shows at most {} frames a second", fastest_gif),
                   ".webp and .apng show up to 60");
}

Result<void> check_film_size(const std::filesystem::path& path, std::int64_t width,
                             std::int64_t height, const std::atomic<bool>& cancel) {
    const FormatOf& format = *format_of(path);
    if (auto fits = check_sides(path, format, width, height); !fits) return fits;
    if (!needs_ffmpeg(format.format)) return {};
    return try_ffmpeg(path, format.format, width, height, cancel);
}

Result<std::unique_ptr<FilmWriter>> begin_film(const std::filesystem::path& path,
                                               const FilmSettings& settings,
                                               std::span<const FilmFrame> samples) {
    CHECK(!samples.empty(), "a film has a frame");
    const FormatOf& format = *format_of(path);
    const std::int64_t width = samples[0].width, height = samples[0].height;
    if (auto fits = check_sides(path, format, width, height); !fits) {
        return tl::unexpected(fits.error());
    }
    switch (format.format) {
        case FilmFormat::gif: return begin_gif(path, settings, samples);
        case FilmFormat::webp: return begin_webp(path, settings, width, height);
        case FilmFormat::apng: return begin_apng(path, settings, width, height);
        case FilmFormat::mp4:
        case FilmFormat::webm: return begin_ffmpeg(path, format.format, settings, samples[0]);
    }
    CHECK(false, "every format has a writer");
}

std::int64_t FrameTimes::next() {
    const auto ends_at = [&](std::int64_t frames) {
        return std::llround(static_cast<double>(frames) * ticks_per_frame_);
    };
    ++frames_;
    return ends_at(frames_) - ends_at(frames_ - 1);
}

}  // namespace cascade
