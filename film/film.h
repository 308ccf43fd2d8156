// Films: frames written one after the other, in the format of the file's ending. Cascade itself
// writes GIF, WebP and APNG, the program ffmpeg the others.
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
/// Browsers slow down faster GIF films.
inline constexpr double fastest_gif = 50;

struct FilmSettings {
    double frames_per_second = 10;  ///< slowest_film … fastest_film; for GIF at most fastest_gif.
    PngTexts texts;                 ///< Written into APNG files.
    /// Set when the program must end. ffmpeg then has to make progress.
    const std::atomic<bool>* cancel = &never_cancelled;
};

/// A film being written. Frames have one size. Each is on its way to the disk when add() returns.
class FilmWriter {
public:
    virtual ~FilmWriter() = default;
    /// Adds a frame.
    virtual Result<void> add(const FilmFrame& frame) = 0;
    /// Completes the file and gives it its name. There must be a frame. Must be the last call.
    virtual Result<void> finish() = 0;
};

/// Checks before any work that a film of this name can be begun: the name is not a pipe's or a
/// device's, and ffmpeg exists if needed.
Result<void> check_film(const std::filesystem::path& path);

/// Checks that players show this many frames per second.
Result<void> check_pace(const std::filesystem::path& path, double frames_per_second);

/// Checks that the format supports frames of this size. Makes ffmpeg encode one. Fails once
/// `cancel` is set.
Result<void> check_film_size(const std::filesystem::path& path, std::int64_t width,
                             std::int64_t height,
                             const std::atomic<bool>& cancel = never_cancelled);

/// Begins a film of frames of the size of the samples, at least one. A GIF has 256 colours, which
/// are chosen for the samples: frames from all over the film, so that colours stay constant from
/// frame to frame.
Result<std::unique_ptr<FilmWriter>> begin_film(const std::filesystem::path& path,
                                               const FilmSettings& settings,
                                               std::span<const FilmFrame> samples);

/// Begins a film of one format, as begin_film() does.
using BeginFilm = Result<std::unique_ptr<FilmWriter>>(const std::filesystem::path& path,
                                                      const FilmSettings& settings,
                                                      std::span<const FilmFrame> samples);
BeginFilm begin_gif, begin_apng, begin_webp;

/// The time for which each frame is shown, in whole ticks, so that rounding errors do not add up.
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
