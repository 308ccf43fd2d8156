// Writes several films of one run at the same time, so that each frame is drawn only once.
#pragma once

#include "core/result.h"
#include "film/film.h"
#include "run/commands/film_request.h"
#include "run/pictures/frames.h"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The frames that a film shows, and its speed.
struct FilmPlan {
    std::vector<std::size_t> frames;  ///< The numbers of the frames, in ascending order.
    double frames_per_second = 10;
};

/// Plans a film of `count` frames. If there are more than `most`, or more than players can show in
/// the requested duration, leaves out frames at equal distances. The first and the last frame are
/// always shown.
FilmPlan film_plan(const FilmRequest& request, std::size_t count, bool has_gif,
                   std::size_t most = std::numeric_limits<std::size_t>::max());

/// Writes all films. If one fails, the others are still written.
class FilmCrew {
public:
    /// A function that draws frame `number` of the plan.
    using Draw = std::function<Result<FilmFrame>(std::size_t number)>;

    FilmCrew(std::vector<std::filesystem::path> films, FilmSettings settings);

    /// Begins all films. Must be called before the first frame is added. The colours of GIF films
    /// are chosen from some of the frames, which `draw` draws before the first frame is added.
    /// Fails if no film can be begun.
    Result<void> begin(const FilmPlan& plan, const Draw& draw);
    /// Adds a frame to all films. Fails if every film has failed.
    Result<void> add(const FilmFrame& frame);
    /// Completes the films. At least one frame must have been added. Returns the paths of the films
    /// that were written.
    std::vector<std::filesystem::path> finish();

    /// Returns frame `number` of the plan if begin() has drawn it, and null otherwise.
    const FilmFrame* drawn(std::size_t number) const;
    bool has_gif() const;
    std::size_t frames() const { return frames_; }
    const std::filesystem::path& first() const { return films_.front().path; }
    const std::optional<Failure>& failure() const { return failure_; }

private:
    struct Film {
        std::filesystem::path path;
        std::unique_ptr<FilmWriter> writer;  ///< Null before begin() and after a failure.
    };
    void note(const Failure& failure);

    std::vector<Film> films_;
    std::vector<std::size_t> numbers_;  ///< The numbers of the frames in `samples_`.
    std::vector<FilmFrame> samples_;
    FilmSettings settings_;
    std::int64_t width_ = 0, height_ = 0;
    std::size_t frames_ = 0;
    std::optional<Failure> failure_;  ///< The first failure of any film.
};

/// Draws the planned frames of a recording and adds them to the films, until `stop` is set. Calls
/// `say` for each frame with its number in the films, counted from 1.
Result<void> film_recorded(FilmCrew& crew, FrameRecorder& frames, Painter& painter,
                           const FilmPlan& plan, int threads, const std::atomic<bool>& stop,
                           const std::function<void(std::size_t number)>& say);

}  // namespace cascade
