// Films of one run that are written together, so that each frame is drawn once.
#pragma once

#include "core/result.h"
#include "film/film.h"
#include "run/commands/film_request.h"

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

/// Which frames a film shows, and how fast.
struct FilmPlan {
    std::vector<std::size_t> frames;  ///< Their numbers, rising.
    double frames_per_second = 10;
};

/// The plan for `count` frames. Where there are more than `most`, or a film is to last so few
/// seconds that players could not follow, frames are left out evenly between the first and the
/// last.
FilmPlan film_plan(const FilmRequest& request, std::size_t count, bool has_gif,
                   std::size_t most = std::numeric_limits<std::size_t>::max());

/// Writes all films. One that fails does not prevent the others.
class FilmCrew {
public:
    /// Draws frame `number` of the plan.
    using Draw = std::function<Result<FilmFrame>(std::size_t number)>;

    FilmCrew(std::vector<std::filesystem::path> films, FilmSettings settings);

    /// Begins the films with their first frame still to be added. The colours of GIF films are
    /// those of some frames of the plan, which `draw` draws. Fails if no film can be begun.
    Result<void> begin(const FilmPlan& plan, const Draw& draw);
    /// Adds a frame. Fails once no film is left that takes it.
    Result<void> add(const FilmFrame& frame);
    /// Completes the films, which have a frame. Returns the paths of those that are written.
    std::vector<std::filesystem::path> finish();

    /// The frame `number` of the plan if begin() has drawn it; else null.
    const FilmFrame* drawn(std::size_t number) const;
    bool has_gif() const;
    std::size_t frames() const { return frames_; }
    const std::filesystem::path& first() const { return films_.front().path; }
    const std::optional<Failure>& failure() const { return failure_; }

private:
    struct Film {
        std::filesystem::path path;
        std::unique_ptr<FilmWriter> writer;  ///< Null before the beginning and after a failure.
    };
    void note(const Failure& failure);

    std::vector<Film> films_;
    std::vector<std::size_t> numbers_;  ///< Of the samples.
    std::vector<FilmFrame> samples_;
    FilmSettings settings_;
    std::int64_t width_ = 0, height_ = 0;
    std::size_t frames_ = 0;
    std::optional<Failure> failure_;  ///< The first one.
};

}  // namespace cascade
