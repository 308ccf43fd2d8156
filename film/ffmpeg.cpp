// Starts ffmpeg directly, without a shell, in a separate process group. So Ctrl-C does not end
// ffmpeg before it has received all drawn frames. ffmpeg writes to a temporary file.
#include "film/ffmpeg.h"

#include "core/check.h"
#include "core/file_format.h"
#include "core/growing_file.h"
#include "film/child_process.h"
#include "film/frames_in_film.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <utility>

namespace cascade {
namespace {

/// The path of a program in the folders of PATH. Empty if there is none.
std::filesystem::path program_named(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        // Relative folders are skipped, because the current folder may contain programs of other
        // people.
        if (!folder.starts_with('/')) continue;
        const std::filesystem::path program = std::filesystem::path(folder) / name;
        if (is_program(program)) return program;
    }
    return {};
}

/// How frames are passed to ffmpeg, and what ffmpeg makes of them.
struct Stream {
    bool is_webm;
    double frames_per_second;
    std::int64_t width, height;
    bool has_alpha;
};

std::vector<std::string> encoder(const Stream& stream) {
    // At this quality, noise in a pattern remains sharp. VP9 requires a bit rate of 0 for constant
    // quality.
    if (!stream.is_webm) {
        return {"-c:v",   "libx264",   "-crf",       "16", "-preset",
                "medium", "-movflags", "+faststart", "-f", "mp4"};
    }
    std::vector<std::string> words = {"-c:v",    "libvpx-vp9", "-crf",      "24", "-b:v", "0",
                                      "-row-mt", "1",          "-cpu-used", "3",  "-f",   "webm"};
    // The encoder cannot use alternate reference frames together with alpha.
    if (stream.has_alpha) words.insert(words.end(), {"-auto-alt-ref", "0"});
    return words;
}

std::vector<std::string> arguments(const Stream& stream) {
    std::vector<std::string> words = {
        "-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-f", "rawvideo", "-pix_fmt",
        stream.has_alpha ? "rgba" : "rgb24", "-video_size",
        fmt::format("{}x{}", stream.width, stream.height), "-framerate",
        fmt::format("{:.6f}", stream.frames_per_second), "-i", "pipe:0",
        // Players use the colour matrix of HDTV if the file names it. The transfer curve is sRGB's.
        "-vf",
        fmt::format("scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,"
                    "format={}",
                    stream.has_alpha ? "yuva420p" : "yuv420p"),
        "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1",
        "-color_range", "tv"};
    for (std::string& word : encoder(stream)) words.push_back(std::move(word));
    return words;
}

std::int64_t even(std::int64_t side) { return side + side % 2; }

class FfmpegWriter : public FilmWriter {
public:
    FfmpegWriter(std::filesystem::path path, Patience patience)
        : path_(std::move(path)),
          patience_(patience),
          is_webm_(is_of_format(path_, FileFormat::webm)) {}

    /// If `file` is null, ffmpeg discards what it encodes.
    Result<void> begin(const FilmSettings& settings, const FilmFrame& first,
                       std::unique_ptr<GrowingFile> file) {
        if (auto found = find_ffmpeg(path_); !found) return found;
        file_ = std::move(file);
        has_alpha_ = is_webm_ && has_alpha(first);
        auto words = arguments({is_webm_, settings.frames_per_second, even(first.width),
                                even(first.height), has_alpha_});
        if (!file_) words.insert(words.end(), {"-f", "null"});
        // "file:" prevents ffmpeg from reading a name as a protocol or an option.
        words.push_back(file_ ? "file:" + file_->temporary_path().string() : "-");
        auto process = ChildProcess::start(program_named("ffmpeg"), words, patience_);
        if (!process) return tl::unexpected(process.error());
        process_ = *std::move(process);
        return {};
    }

    Result<void> add(const FilmFrame& frame) override {
        std::string row, bytes;
        for (std::int64_t y = 0; y < even(frame.height); ++y) {
            if (y < frame.height) row = colours_of(frame, y);
            bytes += row;
        }
        ++frames_;
        if (process_->write(bytes)) return {};
        return outcome();
    }

    Result<void> finish() override {
        if (auto done = outcome(); !done) return done;
        if (!file_) return {};
        const auto held = frames_in_film(file_->temporary_path(), is_webm_);
        if (!held) return failed("it did not write a complete film");
        if (*held != frames_)
            return failed(fmt::format("it wrote {} of {} frames", *held, frames_));
        return file_->complete();
    }

private:
    std::string colours_of(const FilmFrame& frame, std::int64_t y) const {
        std::string row;
        const unsigned char* pixel = frame.row(y);
        for (std::int64_t x = 0; x < even(frame.width); ++x) {
            if (has_alpha_) row.append(reinterpret_cast<const char*>(pixel), 4);
            else append_on_white(pixel, row);
            if (x + 1 < frame.width) pixel += FilmFrame::pixel_bytes;
        }
        return row;
    }

    static void append_on_white(const unsigned char* pixel, std::string& row) {
        for (std::size_t c = 0; c < 3; ++c) {
            const int dark = (255 - pixel[c]) * pixel[3];
            row += static_cast<char>(255 - (dark + 127) / 255);
        }
    }

    /// Waits until ffmpeg has ended, and returns whether it succeeded.
    Result<void> outcome() {
        const ChildProcess::End end = process_->end();
        return end.is_good ? Result<void>() : failed(end.last_words);
    }

    Result<void> failed(const std::string& why) const {
        return failure(fmt::format("ffmpeg could not write '{}': {}", path_.string(), why),
                       "the endings .gif, .webp and .apng need no ffmpeg");
    }

    std::filesystem::path path_;
    Patience patience_;
    bool is_webm_;
    std::int64_t frames_ = 0;
    bool has_alpha_ = false;
    std::unique_ptr<GrowingFile> file_;
    std::unique_ptr<ChildProcess> process_;
};

}  // namespace

Result<void> find_ffmpeg(const std::filesystem::path& film) {
    if (!program_named("ffmpeg").empty()) return {};
    return failure(fmt::format("'{}' needs the program ffmpeg, which is not installed",
                               film.string()),
                   "on Debian: apt-get install ffmpeg; the endings .gif, .webp and .apng do not "
                   "need it");
}

Result<void> try_ffmpeg(const std::filesystem::path& film, std::int64_t width, std::int64_t height,
                        const std::atomic<bool>& cancel) {
    // The result is not needed, so ffmpeg may be ended at once.
    FfmpegWriter writer(film, {cancel, std::chrono::seconds(0), std::chrono::seconds(0)});
    const FilmFrame first = film_frame(Image(width, height));
    if (auto begun = writer.begin({}, first, nullptr); !begun) return begun;
    if (auto done = writer.add(first); !done) return done;
    return writer.finish();
}

Result<std::unique_ptr<FilmWriter>> begin_ffmpeg(const std::filesystem::path& path,
                                                 const FilmSettings& settings,
                                                 std::span<const FilmFrame> samples) {
    auto file = GrowingFile::create(path);
    if (!file) return tl::unexpected(file.error());
    auto film = std::make_unique<FfmpegWriter>(path, Patience{*settings.cancel});
    if (auto begun = film->begin(settings, samples[0], *std::move(file)); !begun) {
        return tl::unexpected(begun.error());
    }
    return film;
}

}  // namespace cascade
