// Writes films, one frame after the other, in the format of the file's ending. This code writes
// GIF, WebP and APNG. The program ffmpeg writes all other formats.
#pragma once

#include "core/file_format.h"
#include "core/result.h"
#include "core/run_control.h"
#include "film/film_frame.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace cascade {

inline constexpr double slowest_film = 0.1;  ///< Frames per second.
inline constexpr double fastest_film = 60;
/// In frames per second. Browsers slow down GIF films that are faster than this.
inline constexpr double fastest_gif = 50;

struct FilmSettings {
    /// From slowest_film to fastest_film. For GIF at most fastest_gif.
    double frames_per_second = 10;
    PngTexts texts;  ///< Written into APNG files.
    /// Set when the program must end. From then on the program waits for ffmpeg only while ffmpeg
    /// makes progress.
    const std::atomic<bool>* cancel = &never_cancelled;
};

/// A film that is being written. All frames have the same size. When add() returns, the frame has
/// been passed on to the file or to ffmpeg.
class FilmWriter {
public:
    virtual ~FilmWriter() = default;
    /// Adds a frame.
    virtual Result<void> add(const FilmFrame& frame) = 0;
    /// Completes the file and gives it its final name. There must be at least one frame. No
    /// function may be called afterwards.
    virtual Result<void> finish() = 0;
};

/// Checks, before any frame is drawn, whether a film with this path could be begun. The path must
/// not name a pipe or a device, and ffmpeg must be installed if the format needs it.
Result<void> check_film(const std::filesystem::path& path);

/// Checks whether players can show this many frames per second.
Result<void> check_pace(const std::filesystem::path& path, double frames_per_second);

/// Checks whether the format allows frames of this size. If ffmpeg writes the format, one frame is
/// encoded as a test. Fails if `cancel` is set.
Result<void> check_film_size(const std::filesystem::path& path, std::int64_t width,
                             std::int64_t height,
                             const std::atomic<bool>& cancel = never_cancelled);

/// Begins a film whose frames have the size of the samples. There must be at least one sample. A
/// GIF has 256 colours, which are chosen from the samples. If the samples come from the whole film,
/// colours stay constant from frame to frame.
Result<std::unique_ptr<FilmWriter>> begin_film(const std::filesystem::path& path,
                                               const FilmSettings& settings,
                                               std::span<const FilmFrame> samples);

/// Begins a film of one format. See begin_film().
using BeginFilm = Result<std::unique_ptr<FilmWriter>>(const std::filesystem::path& path,
                                                      const FilmSettings& settings,
                                                      std::span<const FilmFrame> samples);
BeginFilm begin_gif, begin_apng, begin_webp;

/// Computes how long each frame is shown, as a whole number of ticks, so that rounding errors do
/// not add up.
class FrameTimes {
public:
    FrameTimes(double frames_per_second, double ticks_per_second)
        : ticks_per_frame_(ticks_per_second / frames_per_second) {}
    std::int64_t next();

private:
    double ticks_per_frame_;
    std::int64_t frames_ = 0;
};

}  // namespace cascade
