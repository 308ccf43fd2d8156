// It is erased by moving up and clearing what is below, which every terminal understands.
#include "app/growing_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

/// Short runs show their end alone; then pictures are at least this far apart.
constexpr std::chrono::milliseconds first_after(500), apart(200);
/// Drawing takes at most a tenth of the time.
constexpr int rest_for_drawing = 9;

}  // namespace

std::string in_characters(const Image& image, const Stream& out) {
    if (!out.colour) return plain_characters(image, out.columns());
    constexpr int lines_around = 3;  // The prompt, and what is said of the picture.
    const std::int64_t pixels = 2 * std::max(out.rows() - lines_around, 1);
    const std::int64_t fitting = image.width * pixels / std::max<std::int64_t>(image.height, 1);
    return half_blocks(image,
                       static_cast<int>(std::clamp<std::int64_t>(fitting, 1, out.columns())));
}

GrowingPicture::GrowingPicture(Console& console, LiveRun& run)
    : console_(console), run_(run), next_(Clock::now() + first_after) {
    auto made = Painter::create(run.script(), {});
    if (made) painter_ = std::move(*made);
}

bool GrowingPicture::is_due() const { return painter_ && Clock::now() >= next_; }

void GrowingPicture::draw() {
    const Clock::time_point begun = Clock::now();
    const Canvas canvas = painter_->canvas(run_.simulation());
    const std::string text = in_characters(painter_->image(canvas), console_.out());
    erase();
    console_.draw(text);
    lines_ = std::count(text.begin(), text.end(), '\n');
    const Clock::time_point drawn = Clock::now();
    next_ = drawn + std::max<Clock::duration>(apart, rest_for_drawing * (drawn - begun));
}

void GrowingPicture::erase() {
    if (lines_ > 0) console_.draw(fmt::format("\x1b[{}A\x1b[J", std::exchange(lines_, 0)));
}

}  // namespace cascade
