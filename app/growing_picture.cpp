// Erases a picture by moving the cursor up and clearing everything below, which every terminal can
// do.
#include "app/growing_picture.h"

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

/// The time from the start of the run to the first picture, and the shortest time between pictures.
/// A run that ends before the first picture shows only its final state.
constexpr std::chrono::milliseconds first_after(500), apart(200);
/// The pause after a drawing, as a multiple of the time that the drawing took. So drawing takes at
/// most a tenth of all time.
constexpr int rest_for_drawing = 9;
/// The number by which the terminal recognises this picture, so that a new drawing replaces it.
constexpr std::uint32_t picture_number = 0xca5cade;

}  // namespace

GrowingPicture::GrowingPicture(Console& console, const TerminalPictures& pictures, LiveRun& run)
    : console_(console), pictures_(pictures), run_(run), next_(Clock::now() + first_after) {
    auto made = Painter::create(run.script(), {});
    if (made) painter_ = std::move(*made);
}

bool GrowingPicture::is_due() const { return painter_ && Clock::now() >= next_; }

void GrowingPicture::draw() {
    const Clock::time_point begun = Clock::now();
    const Canvas canvas = painter_->canvas(run_.simulation());
    const std::string text =
        pictures_.draw(painter_->image(canvas), console_.out(), picture_number);
    erase();
    console_.draw(text);
    lines_ = std::count(text.begin(), text.end(), '\n');
    const Clock::time_point drawn = Clock::now();
    next_ = drawn + std::max<Clock::duration>(apart, rest_for_drawing * (drawn - begun));
}

void GrowingPicture::erase() {
    if (lines_ > 0) console_.draw(pictures_.erase(std::exchange(lines_, 0), picture_number));
}

}  // namespace cascade
