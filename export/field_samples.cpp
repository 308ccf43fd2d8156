// Computes filtered values at knots. The knots are so close that values between them are nearly
// linear.
#include "export/field_samples.h"

#include "picture/srgb.h"

#include <algorithm>

namespace cascade {

namespace {

/// The distance between knots, in radii of the filter. The error of linear interpolation is then
/// below 1/255 of the range of the values.
constexpr double knots_apart = 1.0 / 16;
/// The largest number of samples from one knot to the next.
constexpr std::size_t most_steps = 64;

}  // namespace

FieldSamples::FieldSamples(const SurfaceMesh& mesh, const CellFilter& filter,
                           const PaintedCells& cells)
    : mesh_(mesh),
      filter_(filter),
      cells_(cells),
      painter_(filter, cells),
      here_(painter_.number_of_values()),
      there_(here_.size()),
      between_(here_.size()) {}

void FieldSamples::paint(const SampleRow& row) {
    const auto paint = [&](std::size_t k, std::span<const float> values,
                           const SurfacePlace& place) {
        const PlacePainter::Look look = painter_.look_of(values, place);
        row.lights[k] = light_of(look.colour);
        row.heights[k] = look.height;
        row.material[k] = in_light(look.material);
    };
    const std::size_t count = row.lights.size();
    const SurfacePlace begin = row.place(0);
    painter_.filter_at(begin, here_);
    paint(0, here_, begin);
    const std::size_t steps = count > 2 ? steps_of(begin, row.place(1)) : 1;
    for (std::size_t knot = 0, next = 0; knot + 1 < count; knot = next) {
        next = std::min(knot + steps, count - 1);
        const SurfacePlace there = row.place(next);
        painter_.filter_at(there, there_);
        for (std::size_t i = knot + 1; i < next; ++i) {
            const float part = static_cast<float>(i - knot) / static_cast<float>(next - knot);
            for (std::size_t k = 0; k < between_.size(); ++k) {
                between_[k] = here_[k] + part * (there_[k] - here_[k]);
            }
            paint(i, between_, row.place(i));
        }
        paint(next, there_, there);
        std::swap(here_, there_);
    }
}

/// The number of samples from one knot to the next, if neighbouring samples are as far apart as the
/// places `one` and `other`.
std::size_t FieldSamples::steps_of(const SurfacePlace& one, const SurfacePlace& other) const {
    const double apart = length(position_of(mesh_, one) - position_of(mesh_, other));
    const double reach = knots_apart * filter_.radius();
    return apart * static_cast<double>(most_steps) > reach
               ? std::max(static_cast<std::size_t>(reach / apart), std::size_t{1})
               : most_steps;
}

Vector3d FieldSamples::raised_normal(std::span<const SurfacePlace> samples,
                                     const Vector3d& normal) {
    return raised(normal, painter_.rise_at(samples[samples.size() / 2]));
}

}  // namespace cascade
