// Resamples pictures.
#include "picture/grey_picture.h"

#include <algorithm>
#include <cmath>

namespace cascade {
namespace {

/// The weights with which adjacent old pixels add up to a new pixel.
struct Blend {
    std::int64_t first = 0;
    std::vector<double> weights;
};

/// The weights for the mean over the interval of old pixels that the new pixel covers.
Blend mean_over(double begin, double end, std::int64_t count) {
    Blend blend{std::min(static_cast<std::int64_t>(begin), count - 1), {}};
    for (std::int64_t k = blend.first; k < count && static_cast<double>(k) < end; ++k) {
        const double low = std::max(begin, static_cast<double>(k));
        const double high = std::min(end, static_cast<double>(k + 1));
        blend.weights.push_back((high - low) / (end - begin));
    }
    return blend;
}

/// The weights for linear interpolation between the centres of pixels. Beyond the outermost
/// centres, values are constant.
Blend between(double middle, std::int64_t count) {
    const double last = static_cast<double>(count - 1);
    const double position = std::clamp(middle - 0.5, 0.0, last);
    const auto first =
        std::min(static_cast<std::int64_t>(position), std::max<std::int64_t>(count - 2, 0));
    const double share = position - static_cast<double>(first);
    if (count == 1) return {0, {1.0}};
    return {first, {1.0 - share, share}};
}

std::vector<Blend> blends(std::int64_t from, std::int64_t to) {
    std::vector<Blend> result;
    const double ratio = static_cast<double>(from) / static_cast<double>(to);
    for (std::int64_t k = 0; k < to; ++k) {
        const auto number = static_cast<double>(k);
        result.push_back(from > to ? mean_over(number * ratio, (number + 1) * ratio, from)
                                   : between((number + 0.5) * ratio, from));
    }
    return result;
}

/// Computes a new pixel of the line that begins at `start`. The pixels of the line are `stride`
/// apart.
double blended(const std::vector<float>& values, std::int64_t start, std::int64_t stride,
               const Blend& blend) {
    double sum = 0;
    std::int64_t at = start + blend.first * stride;
    for (const double weight : blend.weights) {
        sum += weight * static_cast<double>(values[static_cast<std::size_t>(at)]);
        at += stride;
    }
    return sum;
}

GreyPicture with_width(const GreyPicture& picture, std::int64_t width) {
    GreyPicture result{width, picture.height, {}};
    const std::vector<Blend> columns = blends(picture.width, width);
    for (std::int64_t j = 0; j < picture.height; ++j) {
        for (const Blend& blend : columns) {
            const double value = blended(picture.values, j * picture.width, 1, blend);
            result.values.push_back(static_cast<float>(value));
        }
    }
    return result;
}

GreyPicture with_height(const GreyPicture& picture, std::int64_t height) {
    GreyPicture result{picture.width, height, {}};
    for (const Blend& blend : blends(picture.height, height)) {
        for (std::int64_t i = 0; i < picture.width; ++i) {
            const double value = blended(picture.values, i, picture.width, blend);
            result.values.push_back(static_cast<float>(value));
        }
    }
    return result;
}

}  // namespace

GreyPicture resized(const GreyPicture& picture, std::int64_t width, std::int64_t height) {
    // Begins with the axis after which fewer pixels remain, because a picture may be very narrow.
    if (width * picture.height <= picture.width * height) {
        return with_height(with_width(picture, width), height);
    }
    return with_width(with_height(picture, height), width);
}

Field to_field(const GreyPicture& picture, const Grid& grid) {
    Field field{PlaneLayout(grid)};
    for (std::int64_t k = 0; k < grid.depth; ++k) {
        for (std::int64_t j = 0; j < grid.height; ++j) {
            const auto row = picture.values.begin() + j * picture.width;
            std::copy(row, row + grid.width, &field.at(0, j, k));
        }
    }
    return field;
}

}  // namespace cascade
