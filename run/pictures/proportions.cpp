// Enlarges and shrinks images so that lengths have the proportions of the domain.
#include "run/pictures/proportions.h"

#include "lang/program/grown_lengths.h"
#include "picture/resized_image.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

std::int64_t times(std::int64_t pixels, double factor) {
    const double product = std::round(static_cast<double>(pixels) * factor);
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(product));
}

}  // namespace

PlaneScales scales_of_plane(const Simulation& simulation, const Slice& slice) {
    const std::uint32_t stage = shown_stage(simulation);
    const auto scales = scales_at(simulation.domain().stage(stage), simulation.state(stage).t);
    const bool is_slice = simulation.domain().grid.depth > 1;
    return {scales[is_slice && slice.axis == Axis::x ? 2 : 0],
            scales[is_slice && slice.axis == Axis::y ? 2 : 1]};
}

PlaneScales scales_of_body(const Simulation& simulation) {
    const std::uint32_t stage = shown_stage(simulation);
    const Stage& its = simulation.domain().stage(stage);
    if (!its.growth || !its.growth->is_uniform) return {1, 1};
    const double scale = scales_at(its, simulation.state(stage).t)[0];
    return {scale, scale};
}

Image in_proportion(Image image, const PlaneScales& scales) {
    const double least = std::min(scales[0], scales[1]);
    if (scales[0] == scales[1] || !(least > 0)) return image;
    return resized(image, times(image.width, scales[0] / least),
                   times(image.height, scales[1] / least));
}

Image in_largest(const Image& image, const PlaneScales& scales, const PlaneScales& largest) {
    if (scales == largest) return image;
    const double own = std::min(scales[0], scales[1]), least = std::min(largest[0], largest[1]);
    // The size of the image on which each cell is a square.
    const std::int64_t width = times(image.width, own / scales[0]);
    const std::int64_t height = times(image.height, own / scales[1]);
    const std::int64_t whole_width = times(width, largest[0] / least);
    const std::int64_t whole_height = times(height, largest[1] / least);
    const Image part = resized(image, times(whole_width, scales[0] / largest[0]),
                               times(whole_height, scales[1] / largest[1]));
    return in_the_middle(part, whole_width, whole_height);
}

}  // namespace cascade
