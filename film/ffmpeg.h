// Films encoded by the program ffmpeg.
#pragma once

#include "film/film.h"

namespace cascade {

/// Fails, and says what to install, if no folder of PATH has a program ffmpeg.
Result<void> find_ffmpeg(const std::filesystem::path& film);

/// Makes ffmpeg encode a white frame of this size and drops it. Fails at once if `cancel` is set.
Result<void> try_ffmpeg(const std::filesystem::path& film, std::int64_t width, std::int64_t height,
                        const std::atomic<bool>& cancel);

/// A film in MP4 (H.264) or WebM (VP9) of frames like the first. ffmpeg gets the frames through a
/// pipe. Both formats have colours for squares of two by two pixels, so an odd side gets one more:
/// the last row or column again. A WebM film has alpha if the first frame has it. Otherwise frames
/// are drawn on white. When `cancel` is set, ffmpeg may continue while it makes progress. Its
/// output is a film only if it holds all frames. Writing fails by a signal unless the program
/// ignores SIGPIPE.
BeginFilm begin_ffmpeg;

}  // namespace cascade
