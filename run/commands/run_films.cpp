// Writes films of a run: of its frames, of its end seen from all sides, or of the slices of a
// volume.
#include "core/enough_memory.h"
#include "run/commands/film_crew.h"
#include "run/commands/run_results.h"
#include "run/pictures/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace cascade {

bool films_steps(const RunRequest& request) {
    return request.turntable == 0 && request.slices == 0 &&
           std::any_of(request.outputs.begin(), request.outputs.end(), is_film);
}

Result<void> film_recorded(FilmCrew& crew, FrameRecorder& frames, Painter& painter,
                           const FilmPlan& plan, int threads, const std::atomic<bool>& stop,
                           const std::function<void(std::size_t number)>& say) {
    const auto draw_one = [&](std::size_t number) -> Result<FilmFrame> {
        FilmFrame frame;
        const auto keep = [&](std::size_t, const Image& image) -> Result<FrameRecorder::InOrder> {
            frame = film_frame(image);
            return [] { return Result<void>(); };
        };
        auto drawn = frames.draw(painter, {&number, 1}, 1, never_cancelled, keep);
        if (!drawn) return tl::unexpected(drawn.error());
        return frame;
    };
    if (auto begun = crew.begin(plan, draw_one); !begun) return begun;
    const auto add = [&](std::size_t, const Image& image) -> Result<FrameRecorder::InOrder> {
        return [&, frame = film_frame(image)] {
            say(crew.frames() + 1);
            return crew.add(frame);
        };
    };
    return frames.draw(painter, plan.frames, threads, stop, add);
}

/// Writes all films. If Ctrl-C is pressed while frames are drawn, the films end with the present
/// frame. If Ctrl-C has already ended the run before, all frames of the run are drawn.
Result<void> RunResults::write_films(const Canvas& canvas) {
    std::vector<std::filesystem::path> paths;
    std::copy_if(outputs.begin(), outputs.end(), std::back_inserter(paths), is_film);
    FilmSettings settings;
    settings.texts = texts(painter.request());
    settings.cancel = &control.cancel;
    FilmCrew crew(std::move(paths), std::move(settings));
    auto filmed = request.turntable > 0 ? film_turntable(crew, canvas)
                  : request.slices > 0  ? film_slices(crew)
                                        : film_frames(crew);
    if (!filmed) return filmed;
    const auto written = crew.finish();
    report.written.insert(report.written.end(), written.begin(), written.end());
    if (crew.failure()) return tl::unexpected(*crew.failure());
    return {};
}

/// If Ctrl-C has ended the films, adds a note with the number of frames that were written.
void RunResults::note_end_of_films(const FilmCrew& crew, std::size_t count) {
    if (crew.frames() < count && stop()) {
        note_stop(fmt::format("frame {} of {} of {}", crew.frames(), count, crew.first().string()));
    }
}

Result<void> RunResults::film_frames(FilmCrew& crew) {
    if (auto failed = frames->failure()) return tl::unexpected(*failed);
    if (frames->count() == 0) {
        return failure(fmt::format("'{}' has no frames, because the run took no step",
                                   crew.first().string()),
                       "a film has a frame at the start of a stage and at each 'interval'");
    }
    const FilmPlan plan = film_plan(request.film, frames->count(), crew.has_gif());
    auto drawn =
        film_recorded(crew, *frames, painter, plan, drawing_threads(), stop(), [&](std::size_t k) {
            say(fmt::format("drawing {} of {}", k, plan.frames.size()));
        });
    if (drawn) note_end_of_films(crew, plan.frames.size());
    return drawn;
}

/// Writes films of the end of the run. `draw` draws the `count` pictures one after the other.
Result<void> RunResults::film_end(FilmCrew& crew, int count, const FilmCrew::Draw& draw) {
    const FilmPlan plan = film_plan(request.film, static_cast<std::size_t>(count), crew.has_gif());
    Result<void> done = crew.begin(plan, draw);
    for (const std::size_t number : plan.frames) {
        if (!done || stop()) break;
        say(fmt::format("drawing {} of {}", crew.frames() + 1, plan.frames.size()));
        if (const FilmFrame* frame = crew.drawn(number)) {
            done = crew.add(*frame);
            continue;
        }
        auto frame = enough_memory_for([&] { return draw(number); });
        done = frame ? crew.add(*frame) : Result<void>(tl::unexpected(frame.error()));
    }
    if (done) note_end_of_films(crew, plan.frames.size());
    return done;
}

Result<void> RunResults::film_turntable(FilmCrew& crew, const Canvas& canvas) {
    const auto count = static_cast<std::size_t>(request.turntable);
    auto done = film_end(crew, request.turntable, [&](std::size_t number) -> Result<FilmFrame> {
        painter.set_view(turned_view(number, count));
        return film_frame(painter.image(canvas));
    });
    painter.set_view(request.picture.view);
    return done;
}

/// Writes films of slices at equal distances along the axis of --slice. The colours of all slices
/// cover the range of values of the whole volume.
Result<void> RunResults::film_slices(FilmCrew& crew) {
    const ValueRange range = automatic_range(spread_of([&](const auto& take) {
        const Field number = shown_number(painter, simulation);
        for (const double value : measure::to_samples(number, simulation.domain().grid).values)
            take(value);
    }));
    auto done = film_end(crew, request.slices, [&](std::size_t k) -> Result<FilmFrame> {
        Slice slice = request.picture.slice;
        slice.place = (static_cast<double>(k) + 0.5) / request.slices;
        painter.set_slice(slice);
        return film_frame(painter.image(painter.canvas(simulation), range));
    });
    painter.set_slice(request.picture.slice);
    return done;
}

}  // namespace cascade
