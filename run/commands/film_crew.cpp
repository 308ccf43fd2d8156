// Adds every frame to every film. The colours of GIF films are chosen from a few frames at equal
// distances in time.
#include "run/commands/film_crew.h"

#include "core/enough_memory.h"
#include "core/file_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

constexpr double usual_rate = 10;  // Frames per second.
constexpr std::size_t most_table_frames = 6;

/// Returns at most `most` of the numbers 0 … count − 1, at equal distances and including the first
/// and the last.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
    const std::size_t taken = std::min(count, most);
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < taken; ++k) {
        const double share =
            taken > 1 ? static_cast<double>(k) / static_cast<double>(taken - 1) : 1;
        numbers.push_back(
            static_cast<std::size_t>(std::lround(share * static_cast<double>(count - 1))));
    }
    return numbers;
}

}  // namespace

FilmPlan film_plan(const FilmRequest& request, std::size_t count, bool has_gif, std::size_t most) {
    FilmPlan plan;
    if (request.seconds > 0) {
        const double fastest = has_gif ? fastest_gif : fastest_film;
        const double followed = std::max(1.0, std::floor(fastest * request.seconds));
        most = std::min(most, static_cast<std::size_t>(followed));
    }
    plan.frames = evenly(count, most);
    plan.frames_per_second =
        request.seconds > 0
            ? std::max(static_cast<double>(plan.frames.size()) / request.seconds, slowest_film)
        : request.frames_per_second > 0 ? request.frames_per_second
                                        : usual_rate;
    return plan;
}

FilmCrew::FilmCrew(std::vector<std::filesystem::path> films, FilmSettings settings)
    : settings_(std::move(settings)) {
    for (auto& path : films) films_.push_back({std::move(path), nullptr});
}

bool FilmCrew::has_gif() const {
    return std::any_of(films_.begin(), films_.end(),
                       [](const Film& film) { return is_of_format(film.path, FileFormat::gif); });
}

void FilmCrew::note(const Failure& failure) {
    if (!failure_) failure_ = failure;
}

Result<void> FilmCrew::begin(const FilmPlan& plan, const Draw& draw) {
    settings_.frames_per_second = plan.frames_per_second;
    for (const std::size_t k : evenly(plan.frames.size(), has_gif() ? most_table_frames : 1)) {
        auto frame = enough_memory_for([&] { return draw(plan.frames[k]); });
        if (!frame) return tl::unexpected(frame.error());
        numbers_.push_back(plan.frames[k]);
        samples_.push_back(*std::move(frame));
    }
    width_ = samples_[0].width;
    height_ = samples_[0].height;
    for (Film& film : films_) {
        auto writer = enough_memory_for([&] { return begin_film(film.path, settings_, samples_); });
        if (writer) film.writer = *std::move(writer);
        else note(writer.error());
    }
    const bool has_begun = std::any_of(films_.begin(), films_.end(),
                                       [](const Film& film) { return film.writer != nullptr; });
    if (!has_begun) return tl::unexpected(*failure_);
    return {};
}

const FilmFrame* FilmCrew::drawn(std::size_t number) const {
    const auto found = std::find(numbers_.begin(), numbers_.end(), number);
    return found == numbers_.end() ? nullptr
                                   : &samples_[static_cast<std::size_t>(found - numbers_.begin())];
}

Result<void> FilmCrew::add(const FilmFrame& frame) {
    if (frame.width != width_ || frame.height != height_) {
        note({fmt::format("the film ends here: its frames have {} × {} pixels, but the next "
                          "frame would have {} × {}",
                          width_, height_, frame.width, frame.height),
              "--until-stage can end the run before this frame"});
        for (Film& film : films_) film.writer.reset();
    }
    bool is_taken = false;
    for (Film& film : films_) {
        if (!film.writer) continue;
        const auto added = enough_memory_for([&] { return film.writer->add(frame); });
        is_taken = is_taken || added;
        if (added) continue;
        note(added.error());
        film.writer.reset();
    }
    if (!is_taken) return tl::unexpected(*failure_);
    ++frames_;
    return {};
}

std::vector<std::filesystem::path> FilmCrew::finish() {
    std::vector<std::filesystem::path> written;
    for (Film& film : films_) {
        if (!film.writer || frames_ == 0) continue;
        const auto done = film.writer->finish();
        if (done) written.push_back(film.path);
        else note(done.error());
        film.writer.reset();
    }
    return written;
}

}  // namespace cascade
