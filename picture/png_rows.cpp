// Each row gets the filter whose differences have the smallest sum, as section 12.8 of the PNG
// specification recommends. All loops are plain loops over bytes, so that compilers can
// vectorise them.
#include "picture/png_rows.h"

#include "core/wide_vectors.h"
#include "picture/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace cascade {
namespace {

using Byte = std::uint8_t;

unsigned highest_level(PngDepth depth) { return (1U << static_cast<unsigned>(depth)) - 1; }

bool are_grey(std::span<const Colour> pixels, unsigned highest) {
    return std::all_of(pixels.begin(), pixels.end(), [highest](const Colour& pixel) {
        if (pixel[0] == pixel[1] && pixel[0] == pixel[2]) return true;
        const unsigned red = level_of(pixel[0], highest);
        return red == level_of(pixel[1], highest) && red == level_of(pixel[2], highest);
    });
}

/// Whether any pixel is transparent.
WITH_WIDE_VECTORS bool show_background(std::span<const Colour> pixels) {
    int is_one = 0;
    for (const Colour& pixel : pixels) is_one |= static_cast<int>(is_transparent(pixel));
    return is_one != 0;
}

/// Finds the levels of the first `channels` channels of each pixel.
WITH_WIDE_VECTORS void find_levels(std::span<const Colour> pixels, std::size_t channels,
                                   unsigned highest, std::uint16_t* levels) {
    const auto level = [highest](float value) {
        return static_cast<std::uint16_t>(level_of(value, highest));
    };
    if (channels == 1) {
        for (std::size_t k = 0; k < pixels.size(); ++k) levels[k] = level(pixels[k][0]);
        return;
    }
    const float* const values = pixels.data()->data();
    for (std::size_t k = 0; k < 3 * pixels.size(); ++k) levels[k] = level(values[k]);
}

/// Finds the levels of grey pixels. Returns false if the three channels of a pixel are not equal.
WITH_WIDE_VECTORS bool find_grey_levels(std::span<const Colour> pixels, unsigned highest,
                                        std::uint16_t* levels) {
    int differ = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        const auto& [red, green, blue] = pixels[k];
        levels[k] = static_cast<std::uint16_t>(level_of(red, highest));
        differ |= (red != green) | (red != blue);
    }
    return differ == 0;
}

/// Finds the levels of values for a palette with two greys, as paint() would draw them. Returns
/// false if a value is NaN.
WITH_WIDE_VECTORS bool find_painted_levels(std::span<const float> values, const Painting& how,
                                           unsigned highest, std::uint16_t* levels) {
    const double low = static_cast<double>(how.range.low);
    const double width = static_cast<double>(how.range.high) - low;
    const double from = static_cast<double>(how.palette.stops[0][0]);
    const double rise = static_cast<double>(how.palette.stops[1][0]) - from;
    // The number is 1, but compilers do not vectorise the loop if they can deduce this.
    const double last = static_cast<double>(how.palette.stops.size() - 1);
    int is_one_nan = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double value = static_cast<double>(values[k]);
        const double position = width == 0 ? 0.5 : (value - low) / width;
        is_one_nan |= static_cast<int>(std::isnan(values[k]));
        const double above = position > 0 ? position : 0.0;
        const double part = above < last ? above : last;
        const float grey = static_cast<float>(from + rise * part);
        levels[k] = static_cast<std::uint16_t>(static_cast<int>(double{grey} * highest + 0.5));
    }
    return is_one_nan == 0;
}

/// A row of pixels. `alpha` points to the opacity of the first pixel, or is null.
struct PixelRow {
    std::span<const Colour> pixels;
    const float* alpha;
};

PixelRow pixel_row(const Image& image, std::int64_t y) {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t first = static_cast<std::size_t>(y) * width;
    return {{&image.pixels[first], width}, image.alpha.empty() ? nullptr : &image.alpha[first]};
}

/// Writes the samples of rows in a fixed format.
class SampleWriter {
public:
    SampleWriter(const PngFormat& format, std::size_t width)
        : format_(format), levels_(width * format.colours()) {}

    /// Writes opaque grey pixels, the most common format. Returns false if the format is another or
    /// a pixel is not an opaque grey.
    bool put_grey(const PixelRow& row, Byte* out) {
        if (!format_.is_grey || format_.has_alpha) return false;
        if (!find_grey_levels(row.pixels, highest_, levels_.data())) return false;
        put_levels(out);
        return true;
    }

    void put(const PixelRow& row, Byte* out) {
        find_levels(row.pixels, format_.colours(), highest_, levels_.data());
        if (format_.has_alpha) {
            put_with_alpha(row, out);
        } else {
            put_levels(out);
        }
    }

    /// Writes values for a palette with two greys. Returns false if a value is NaN.
    bool put_painted(std::span<const float> values, const Painting& how, Byte* out) {
        if (!find_painted_levels(values, how, highest_, levels_.data())) return false;
        put_levels(out);
        return true;
    }

private:
    void put_levels(Byte* out) const {
        if (format_.depth == PngDepth::eight) {
            for (const std::uint16_t level : levels_) *out++ = static_cast<Byte>(level);
        } else {
            for (const std::uint16_t level : levels_) {
                *out++ = static_cast<Byte>(level >> 8);
                *out++ = static_cast<Byte>(level & 0xffU);
            }
        }
    }

    /// Writes pixels with alpha. Transparent pixels are white, for programs that ignore alpha.
    void put_with_alpha(const PixelRow& row, Byte* out) const {
        const auto put = [&](unsigned level) {
            if (format_.depth == PngDepth::sixteen) *out++ = static_cast<Byte>(level >> 8);
            *out++ = static_cast<Byte>(level & 0xffU);
        };
        const std::uint16_t* level = levels_.data();
        for (std::size_t k = 0; k < row.pixels.size(); ++k) {
            const bool is_seen = !is_transparent(row.pixels[k]);
            for (std::size_t c = 0; c < format_.colours(); ++c, ++level) {
                put(is_seen ? *level : highest_);
            }
            const unsigned opaque = row.alpha ? level_of(row.alpha[k], highest_) : highest_;
            put(is_seen ? opaque : 0);
        }
    }

    PngFormat format_;
    unsigned highest_ = highest_level(format_.depth);
    std::vector<std::uint16_t> levels_;  ///< The levels of a row.
};

/// The number of bytes in a row, including the number of its filter.
std::size_t bytes_of_row(const PngFormat& format, std::int64_t width) {
    return 1 + static_cast<std::size_t>(width) * format.pixel_bytes();
}

/// Writes all rows in the format of `rows`. If a row needs more channels, adds them to the format
/// and returns false.
bool put_rows(const Image& image, PngRows& rows) {
    const PngFormat format = rows.format;
    const std::size_t count = bytes_of_row(format, image.width);
    rows.bytes.assign(count * static_cast<std::size_t>(image.height), 0);
    SampleWriter writer(format, static_cast<std::size_t>(image.width));
    Byte* out = rows.bytes.data();
    for (std::int64_t y = 0; y < image.height; ++y, out += count) {
        const PixelRow row = pixel_row(image, y);
        if (writer.put_grey(row, out + 1)) continue;
        rows.format.is_grey = format.is_grey && are_grey(row.pixels, highest_level(format.depth));
        rows.format.has_alpha = format.has_alpha || show_background(row.pixels);
        if (rows.format != format) return false;
        writer.put(row, out + 1);
    }
    return true;
}

/// Writes all rows as opaque grey. Returns false if the palette has other colours or a value is
/// NaN.
bool put_painted_rows(const Painting& painting, PngRows& rows) {
    if (!painting.has_two_greys()) return false;
    const PlaneLayout& layout = painting.field.layout();
    const auto width = static_cast<std::size_t>(layout.width);
    const std::size_t count = bytes_of_row(rows.format, layout.width);
    rows.bytes.assign(count * static_cast<std::size_t>(layout.height), 0);
    SampleWriter writer(rows.format, width);
    Byte* out = rows.bytes.data();
    for (std::int64_t y = 0; y < layout.height; ++y, out += count) {
        if (!writer.put_painted({painting.field.row(y), width}, painting, out + 1)) return false;
    }
    return true;
}

Byte byte_distance(Byte one, Byte other) {
    return static_cast<Byte>(std::max(one, other) - std::min(one, other));
}

/// The prediction of filter 4: of the bytes on the left, above, and above to the left (the corner),
/// the one that is nearest to left + above − corner. Computes with bytes only, because a vector
/// holds more bytes than wider numbers.
Byte paeth(Byte left, Byte above, Byte corner) {
    const Byte by_left = byte_distance(above, corner), by_above = byte_distance(left, corner);
    // If the corner is not between the two others, it is farthest from the sum.
    const bool is_between = (above >= corner) != (left >= corner);
    const Byte by_corner = is_between ? byte_distance(by_left, by_above) : Byte{255};
    const Byte upper = by_above <= by_corner ? above : corner;
    return by_left <= by_above && by_left <= by_corner ? left : upper;
}

constexpr std::size_t filters = 5;

/// Applies each of the five filters to a row. `row` and `above` must follow a pixel of zeros.
WITH_WIDE_VECTORS void filter(const Byte* row, const Byte* above, std::size_t count,
                              std::size_t pixel, std::array<std::vector<Byte>, filters>& results) {
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

/// The sum of the absolute values of differences. A difference is a byte modulo 256.
WITH_WIDE_VECTORS std::uint32_t size_of(const std::vector<Byte>& differences) {
    constexpr std::size_t at_once = 256;  // The sum of this many bytes fits into 16 bits.
    std::uint32_t sum = 0;
    for (std::size_t begin = 0; begin < differences.size(); begin += at_once) {
        const std::size_t end = std::min(differences.size(), begin + at_once);
        std::uint16_t part = 0;
        for (std::size_t k = begin; k < end; ++k) {
            const auto negative = static_cast<Byte>(-differences[k]);
            part = static_cast<std::uint16_t>(part + std::min(differences[k], negative));
        }
        sum += part;
    }
    return sum;
}

}  // namespace

bool Painting::has_two_greys() const {
    const auto is_grey = [](const Colour& stop) {
        return stop[0] == stop[1] && stop[0] == stop[2] && stop[0] >= 0 && stop[0] <= 1;
    };
    return palette.stops.size() == 2 && std::ranges::all_of(palette.stops, is_grey) &&
           std::isfinite(range.low) && std::isfinite(range.high);
}

void filter_rows(std::span<std::uint8_t> rows, std::size_t count, std::size_t pixel) {
    std::vector<Byte> row(pixel + count), above(pixel + count);
    std::array<std::vector<Byte>, filters> results;
    results.fill(std::vector<Byte>(count));
    // Goes from the last row to the first, so that the row above is still unfiltered.
    const auto take = [&](std::size_t end, std::vector<Byte>& to) {
        if (end == 0) std::fill(to.begin(), to.end(), Byte{0});
        else std::copy_n(rows.begin() + (end - count), count, to.begin() + pixel);
    };
    take(rows.size(), row);
    for (std::size_t end = rows.size(); end > 0; end -= 1 + count) {
        take(end - (1 + count), above);
        filter(row.data() + pixel, above.data() + pixel, count, pixel, results);
        std::array<std::uint32_t, filters> sizes{};
        std::transform(results.begin(), results.end(), sizes.begin(), size_of);
        const auto best = std::min_element(sizes.begin(), sizes.end()) - sizes.begin();
        Byte* const out = rows.data() + (end - (1 + count));
        *out = static_cast<Byte>(best);
        std::ranges::copy(results[static_cast<std::size_t>(best)], out + 1);
        std::swap(row, above);
    }
}

PngRows png_rows(const Image& image, PngDepth depth) {
    PngRows rows{{depth, true, !image.alpha.empty()}, {}};
    while (!put_rows(image, rows)) {
    }
    filter_rows(rows.bytes, bytes_of_row(rows.format, image.width) - 1, rows.format.pixel_bytes());
    return rows;
}

PngRows png_rows(const Painting& painting, PngDepth depth) {
    PngRows rows{{depth, true, false}, {}};
    if (!put_painted_rows(painting, rows)) {
        return png_rows(paint(painting.field, painting.range, painting.palette), depth);
    }
    const std::int64_t width = painting.field.layout().width;
    filter_rows(rows.bytes, bytes_of_row(rows.format, width) - 1, rows.format.pixel_bytes());
    return rows;
}

}  // namespace cascade
