// The part of the public library (include/cascade/cascade.h) that films a pattern while it takes
// its steps.
#include "core/file.h"
#include "core/file_format.h"
#include "core/parallel.h"
#include "film/film.h"
#include "library/file_options.h"
#include "library/pattern_state.h"
#include "run/commands/film_crew.h"
#include "run/script/embedded_script.h"
#include "run/session/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace cascade {
namespace {

/// The steps between frames if the caller gives no number. This is the smallest interval of the
/// remaining stages that have steps. A stage without an interval counts with a fiftieth of its
/// steps.
std::int64_t usual_steps_between_frames(const LiveRun& run) {
    constexpr std::int64_t frames_of_stage = 50;
    std::int64_t every = std::numeric_limits<std::int64_t>::max();
    for (std::uint32_t k = run.place().stage; k < run.script().stage_count(); ++k) {
        const Stage& stage = run.script().program->stages[k];
        const bool has_interval = stage.interval > 0;
        if (stage.iterations == 0) continue;
        every = std::min(every, has_interval ? stage.interval : stage.iterations / frames_of_stage);
    }
    return std::max<std::int64_t>(every, 1);
}

/// Fails, before the first step, if the film could not be written.
Result<void> check_film_of(const LiveRun& run, Painter& painter, const std::filesystem::path& path,
                           const FilmRequest& film) {
    if (!is_film(path)) {
        return failure(fmt::format("'{}' does not have the ending of a film", path.string()),
                       fmt::format("films are {}", endings_of(FormatKind::film, "or")));
    }
    if (auto good = check_film(path); !good) return good;
    if (auto good = check_writable(path); !good) return good;
    if (auto good = check_pace(path, film.frames_per_second); !good) return good;
    const Image first = painter.image(painter.canvas(run.simulation()));
    return check_film_size(path, first.width, first.height);
}

}  // namespace

/// Takes all remaining steps and records a frame after every `every` steps, at the start and at the
/// end.
Result<void> Pattern::Implementation::record(FrameRecorder& frames, Painter& painter,
                                             std::int64_t every, const ProgressWatcher& watcher) {
    std::optional<RunPlace> last;
    Watching watching;
    watching.every = every > 0 ? every : usual_steps_between_frames(*run);
    watching.observe = [&] {
        if (last == run->place()) return;
        last = run->place();
        frames.record(painter.canvas(run->simulation()), current().name, last->steps);
    };
    watching.observe();
    advance(std::numeric_limits<std::int64_t>::max(), watcher, std::move(watching));
    if (!running() || !check()) return failure(problem.text, problem.hint);
    if (!run->is_over()) return failure("the film was cancelled");
    if (last != run->place()) {
        frames.record(painter.canvas(run->simulation()), current().name, run->place().steps);
    }
    if (const auto& full = frames.failure()) return tl::unexpected(*full);
    return {};
}

Result<void> Pattern::Implementation::write_film(const std::filesystem::path& path,
                                                 FrameRecorder& frames, Painter& painter,
                                                 const FilmRequest& pace,
                                                 const ProgressWatcher& watcher) {
    FilmSettings settings;
    settings.texts = embed_script(run->script(), painter.request());
    settings.cancel = &control.cancel;
    FilmCrew crew({path}, std::move(settings));
    const FilmPlan plan = film_plan(pace, frames.count(), crew.has_gif());
    const auto tell = [&](std::size_t) {
        PatternProgress now;
        now.stage = current().name;
        now.step = now.steps = run->place().steps;
        if (watcher && !watcher(now)) control.cancel = true;
    };
    control.cancel = false;
    auto drawn =
        film_recorded(crew, frames, painter, plan, hardware_threads(), control.cancel, tell);
    if (!drawn) return drawn;
    if (control.cancel) return failure("the film was cancelled");
    crew.finish();
    if (crew.failure()) return tl::unexpected(*crew.failure());
    return {};
}

bool Pattern::film(const std::string& path, std::int64_t every, const std::string& options,
                   const ProgressWatcher& watcher) {
    if (!self_->running() || !self_->check()) return false;
    self_->forget_error();
    const auto fail = [&](const Failure& why) {
        self_->note(why);
        return false;
    };
    if (every < 0) return fail({"the number of steps between two frames is negative", ""});
    const auto request = file_request(options);
    if (!request) return fail(request.error());
    auto painter = make_painter(*self_->run, request->picture);
    if (!painter) {
        self_->note(painter.error());
        return false;
    }
    if (auto good = check_film_of(*self_->run, *painter, path, request->film); !good) {
        return fail(good.error());
    }
    auto frames = FrameRecorder::create(true, false);
    if (!frames) return fail(frames.error());
    auto done = self_->record(*frames, *painter, every, watcher);
    if (done) done = self_->write_film(path, *frames, *painter, request->film, watcher);
    return done ? true : fail(done.error());
}

}  // namespace cascade
