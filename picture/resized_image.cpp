// Averages rows first, then columns.
#include "picture/resized_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cascade {

namespace {

/// The red, green and blue of a pixel, each times the opacity, and the opacity.
using Weighted = std::array<float, 4>;

/// Computes the means of `count` values over `parts` equal intervals. Gets value k by `value(k)`,
/// and calls `put(part, mean)` for each interval.
template <typename ValueAt, typename Put>
void average(std::int64_t count, std::int64_t parts, const ValueAt& value, const Put& put) {
    const double step = static_cast<double>(count) / static_cast<double>(parts);
    for (std::int64_t part = 0; part < parts; ++part) {
        const double from = static_cast<double>(part) * step;
        const double to = std::min(from + step, static_cast<double>(count));
        Weighted sum{};
        for (auto k = static_cast<std::int64_t>(from); static_cast<double>(k) < to; ++k) {
            const double overlap =
                std::min(to, static_cast<double>(k + 1)) - std::max(from, static_cast<double>(k));
            if (overlap <= 0) continue;
            const Weighted& each = value(k);
            for (std::size_t c = 0; c < sum.size(); ++c)
                sum[c] += static_cast<float>(overlap) * each[c];
        }
        for (float& channel : sum) channel /= static_cast<float>(to - from);
        put(part, sum);
    }
}

void put_pixel(Image& image, std::int64_t x, std::int64_t y, const Weighted& mean) {
    constexpr float opaque = 1 - 1e-5F;
    const float opacity = mean[3];
    if (opacity <= 0) {
        image.at(x, y) = transparent;
        return;
    }
    image.at(x, y) = {mean[0] / opacity, mean[1] / opacity, mean[2] / opacity};
    if (opacity >= opaque) return;
    if (image.alpha.empty()) image.alpha.assign(image.pixels.size(), 1);
    image.alpha_at(x, y) = opacity;
}

}  // namespace

Image resized(const Image& image, std::int64_t width, std::int64_t height) {
    if (width == image.width && height == image.height) return image;
    std::vector<Weighted> row(static_cast<std::size_t>(image.width));
    // The image with the new number of columns and the old number of rows, column by column.
    std::vector<Weighted> narrow(static_cast<std::size_t>(width * image.height));
    const auto place = [&](std::int64_t x, std::int64_t y) {
        return static_cast<std::size_t>(x * image.height + y);
    };
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            const float opacity = image.opacity(x, y);
            const Colour& pixel = image.at(x, y);
            row[static_cast<std::size_t>(x)] =
                opacity > 0
                    ? Weighted{pixel[0] * opacity, pixel[1] * opacity, pixel[2] * opacity, opacity}
                    : Weighted{};
        }
        average(
            image.width, width,
            [&](std::int64_t k) -> const Weighted& { return row[static_cast<std::size_t>(k)]; },
            [&](std::int64_t x, const Weighted& mean) { narrow[place(x, y)] = mean; });
    }
    Image result(width, height);
    for (std::int64_t x = 0; x < width; ++x) {
        average(
            image.height, height,
            [&](std::int64_t k) -> const Weighted& { return narrow[place(x, k)]; },
            [&](std::int64_t y, const Weighted& mean) { put_pixel(result, x, y, mean); });
    }
    return result;
}

Image in_the_middle(const Image& image, std::int64_t width, std::int64_t height) {
    if (width == image.width && height == image.height) return image;
    Image result(width, height, transparent);
    if (!image.alpha.empty()) result.alpha.assign(result.pixels.size(), 1);
    const std::int64_t left = (width - image.width) / 2, top = (height - image.height) / 2;
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            result.at(left + x, top + y) = image.at(x, y);
            if (!image.alpha.empty()) {
                result.alpha_at(left + x, top + y) =
                    image.alpha[static_cast<std::size_t>(y * image.width + x)];
            }
        }
    }
    return result;
}

}  // namespace cascade
