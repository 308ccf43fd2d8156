// Rows are filtered as section 12.8 of the PNG specification recommends: the filter whose
// differences have the smallest sum is taken for each row. All loops are plain ones over bytes,
// so that compilers vectorise them.
#include "picture/png_rows.h"

#include "picture/srgb.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <utility>

namespace cascade {
namespace {

using Byte = std::uint8_t;

bool is_grey(const Colour& pixel, unsigned highest) {
    if (pixel[0] == pixel[1] && pixel[0] == pixel[2]) return true;
    const unsigned red = level_of(pixel[0], highest);
    return red == level_of(pixel[1], highest) && red == level_of(pixel[2], highest);
}

unsigned highest_level(PngDepth depth) { return (1U << static_cast<unsigned>(depth)) - 1; }

/// Writes the first `colours` channels of each pixel, and alpha if there is one, as levels. `alpha`
/// is of the first pixel, or null. The format is a matter of compilation, since this is done for
/// every pixel.
template <PngDepth depth, std::size_t colours, bool has_alpha>
void put_samples(std::span<const Colour> pixels, const float* alpha, Byte* out) {
    const auto put = [&out](float value) {
        const unsigned level = level_of(value, highest_level(depth));
        if constexpr (depth == PngDepth::sixteen) *out++ = static_cast<Byte>(level >> 8);
        *out++ = static_cast<Byte>(level & 0xffU);
    };
    for (const Colour& pixel : pixels) {
        // Transparent pixels are white, for programs that ignore alpha.
        const bool is_seen = !has_alpha || !is_transparent(pixel);
        for (std::size_t c = 0; c < colours; ++c) put(is_seen ? pixel[c] : 1);
        if constexpr (has_alpha) {
            put(!is_seen ? 0 : alpha != nullptr ? *alpha : 1);
            if (alpha != nullptr) ++alpha;
        }
    }
}

template <PngDepth depth>
auto sample_writer(const PngFormat& format) {
    if (format.is_grey) {
        return format.has_alpha ? put_samples<depth, 1, true> : put_samples<depth, 1, false>;
    }
    return format.has_alpha ? put_samples<depth, 3, true> : put_samples<depth, 3, false>;
}

/// The prediction of filter 4 from the bytes to the left, above, and above to the left.
Byte paeth(int left, int above, int corner) {
    const int by_left = std::abs(above - corner), by_above = std::abs(left - corner);
    const int by_corner = std::abs(left + above - 2 * corner);
    const int upper = by_above <= by_corner ? above : corner;
    return static_cast<Byte>(by_left <= by_above && by_left <= by_corner ? left : upper);
}

constexpr std::size_t filters = 5;

/// A row after each of the five filters. `row` and `above` are preceded by a pixel of zeros.
void filter(const Byte* row, const Byte* above, std::size_t count, std::size_t pixel,
            std::array<std::vector<Byte>, filters>& results) {
    const Byte* left = row - pixel;
    const Byte* corner = above - pixel;
    const auto subtract = [&](std::size_t number, const auto& prediction) {
        Byte* out = results[number].data();
        for (std::size_t k = 0; k < count; ++k) {
            out[k] = static_cast<Byte>(row[k] - prediction(k));
        }
    };
    subtract(0, [](std::size_t) { return 0; });
    subtract(1, [&](std::size_t k) { return left[k]; });
    subtract(2, [&](std::size_t k) { return above[k]; });
    subtract(3, [&](std::size_t k) { return (left[k] + above[k]) / 2; });
    subtract(4, [&](std::size_t k) { return paeth(left[k], above[k], corner[k]); });
}

/// The sum of the absolute values of differences, which are bytes modulo 256.
std::uint32_t size_of(const std::vector<Byte>& differences) {
    std::uint32_t sum = 0;
    for (const Byte difference : differences) {
        sum += static_cast<unsigned>(std::abs(static_cast<std::int8_t>(difference)));
    }
    return sum;
}

}  // namespace

PngFormat png_format(const Image& image, PngDepth depth) {
    const unsigned highest = highest_level(depth);
    const auto& pixels = image.pixels;
    const auto grey = [highest](const Colour& pixel) { return is_grey(pixel, highest); };
    return {depth, std::all_of(pixels.begin(), pixels.end(), grey),
            !image.alpha.empty() || std::any_of(pixels.begin(), pixels.end(), is_transparent)};
}

std::vector<std::uint8_t> filtered_rows(std::int64_t height, std::size_t count, std::size_t pixel,
                                        const PutRow& put) {
    std::vector<Byte> row(pixel + count), above(pixel + count);
    std::array<std::vector<Byte>, filters> results;
    results.fill(std::vector<Byte>(count));
    std::vector<Byte> rows;
    rows.reserve((1 + count) * static_cast<std::size_t>(height));
    for (std::int64_t y = 0; y < height; ++y) {
        put(y, row.data() + pixel);
        filter(row.data() + pixel, above.data() + pixel, count, pixel, results);
        std::array<std::uint32_t, filters> sizes{};
        std::transform(results.begin(), results.end(), sizes.begin(), size_of);
        const auto best = std::min_element(sizes.begin(), sizes.end()) - sizes.begin();
        const std::vector<Byte>& result = results[static_cast<std::size_t>(best)];
        rows.push_back(static_cast<Byte>(best));
        rows.insert(rows.end(), result.begin(), result.end());
        std::swap(row, above);
    }
    return rows;
}

std::vector<std::uint8_t> png_rows(const Image& image, const PngFormat& format) {
    const auto width = static_cast<std::size_t>(image.width);
    const auto put = format.depth == PngDepth::eight ? sample_writer<PngDepth::eight>(format)
                                                     : sample_writer<PngDepth::sixteen>(format);
    const auto alpha_of = [&](std::int64_t y) {
        return image.alpha.empty() ? nullptr : &image.alpha[static_cast<std::size_t>(y) * width];
    };
    return filtered_rows(image.height, width * format.pixel_bytes(), format.pixel_bytes(),
                         [&](std::int64_t y, Byte* out) {
                             put({&image.at(0, y), width}, alpha_of(y), out);
                         });
}

}  // namespace cascade
