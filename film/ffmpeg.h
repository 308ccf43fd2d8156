// Makes films with the program ffmpeg.
#pragma once

#include "film/film.h"

namespace cascade {

/// Fails if no folder of PATH contains the program ffmpeg. The error says what to install.
Result<void> find_ffmpeg(const std::filesystem::path& film);

/// Makes ffmpeg encode a white frame of this size, and discards the result. Fails at once if
/// `cancel` is set.
Result<void> try_ffmpeg(const std::filesystem::path& film, std::int64_t width, std::int64_t height,
                        const std::atomic<bool>& cancel);

/// Begins a film in MP4 (H.264) or WebM (VP9), whose frames have the size of the first sample.
/// ffmpeg receives the frames through a pipe. Both formats store colours for squares of two by two
/// pixels, so an odd number of columns or rows is made even by repeating the last one. A WebM film
/// has alpha if the first sample has alpha. Otherwise frames are drawn on white. After `cancel` is
/// set, ffmpeg may continue while it makes progress. Its output is used only if it contains all
/// frames. A failed write raises SIGPIPE unless the program ignores that signal.
BeginFilm begin_ffmpeg;

}  // namespace cascade
