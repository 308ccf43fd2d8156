// Draws fields as images, with ranges and palettes, and enlarges images.
#include "core/check.h"
#include "core/wide_vectors.h"
#include "picture/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace cascade {
/// This is computed in double, so that the width of the range cannot overflow.
double position_in(ValueRange range, float value) {
    if (std::isnan(value)) return std::numeric_limits<double>::quiet_NaN();
    const double low = static_cast<double>(range.low);
    const double width = static_cast<double>(range.high) - low;
    if (width == 0) return 0.5;
    return (static_cast<double>(value) - low) / width;
}

namespace {

constexpr std::size_t painted_at_once = 256;

/// The position of each value in a palette: the segment between two stops, and the fraction of the
/// segment before the value.
struct PalettePlaces {
    std::array<std::int32_t, painted_at_once> segment;
    std::array<double, painted_at_once> part;
};

/// Finds the positions of at most `painted_at_once` values in a palette of `last` segments. NaN
/// gets the segment `last`.
WITH_WIDE_VECTORS void find_palette_places(std::span<const float> values, ValueRange range,
                                           std::int32_t last, PalettePlaces& places) {
    const double low = static_cast<double>(range.low);
    const double width = static_cast<double>(range.high) - low;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double value = static_cast<double>(values[k]);
        // The same computation as in position_in().
        const double position = width == 0 ? 0.5 : (value - low) / width;
        const bool is_nan = value != value || position != position;
        const double above = position > 0 ? position : 0.0;
        const double place = (above < 1 ? above : 1.0) * static_cast<double>(last);
        const auto whole = static_cast<std::int32_t>(place);
        const std::int32_t left = whole < last ? whole : last - 1;
        places.segment[k] = is_nan ? last : left;
        places.part[k] = place - static_cast<double>(left);
    }
}

/// The colours of a palette from one stop to the next.
struct PaletteSegment {
    std::array<double, 3> from{}, rise{};

    Colour at(double part) const {
        const auto channel = [&](std::size_t c) {
            return static_cast<float>(from[c] + rise[c] * part);
        };
        return {channel(0), channel(1), channel(2)};
    }
};

/// Paints values that are all in one segment.
WITH_WIDE_VECTORS void paint_segment(const PaletteSegment& segment, std::span<const double> parts,
                                     Colour* pixels) {
    const PaletteSegment here = segment;
    for (std::size_t k = 0; k < parts.size(); ++k) pixels[k] = here.at(parts[k]);
}

/// Paints many values at once. Each pixel equals the result of colour_at() and position_in().
class PalettePainter {
public:
    PalettePainter(ValueRange range, const Palette& palette)
        : range_(range), segments_(palette.stops.size()) {
        for (std::size_t channel = 0; channel < colour_of_nan.size(); ++channel) {
            for (std::size_t left = 0; left + 1 < segments_.size(); ++left) {
                const double from = static_cast<double>(palette.stops[left][channel]);
                const double to = static_cast<double>(palette.stops[left + 1][channel]);
                segments_[left].from[channel] = from;
                segments_[left].rise[channel] = to - from;
            }
            segments_.back().from[channel] = static_cast<double>(colour_of_nan[channel]);
        }
    }

    void paint(std::span<const float> values, Colour* pixels) const {
        const auto last = static_cast<std::int32_t>(segments_.size() - 1);
        PalettePlaces places;
        while (!values.empty()) {
            const std::size_t count = std::min(values.size(), painted_at_once);
            find_palette_places(values.first(count), range_, last, places);
            std::int32_t others = 0;
            for (std::size_t k = 0; k < count; ++k) others |= places.segment[k];
            if (others == 0) {
                paint_segment(segments_[0], std::span(places.part).first(count), pixels);
            } else {
                for (std::size_t k = 0; k < count; ++k) {
                    const auto number = static_cast<std::size_t>(places.segment[k]);
                    pixels[k] = segments_[number].at(places.part[k]);
                }
            }
            values = values.subspan(count);
            pixels += count;
        }
    }

private:
    ValueRange range_;
    std::vector<PaletteSegment> segments_;  ///< The last segment is for NaN.
};

/// An image with the size of a plane. Its pixels are not set.
Image unpainted(const PlaneLayout& layout, Image image) {
    image.width = layout.width;
    image.height = layout.height;
    image.pixels.resize(static_cast<std::size_t>(image.width * image.height));
    image.alpha.clear();
    return image;
}

}  // namespace

Spread spread_of(const Field& field) {
    const PlaneLayout& layout = field.layout();
    Spread spread;
    for (std::int64_t j = 0; j < layout.height; ++j) {
        spread.add(spread_of(std::span(field.row(j), static_cast<std::size_t>(layout.width))));
    }
    return spread;
}

ValueRange automatic_range(const Spread& values) {
    if (values.count == 0) return {0, 0};
    if (values.is_uniform()) {
        const auto middle = static_cast<float>(values.mean);
        return {middle, middle};
    }
    return {static_cast<float>(values.smallest), static_cast<float>(values.largest)};
}

Image paint(const Field& field, ValueRange range, const Palette& palette, Image earlier) {
    const PlaneLayout& layout = field.layout();
    Image image = unpainted(layout, std::move(earlier));
    const PalettePainter painter(range, palette);
    for (std::int64_t j = 0; j < layout.height; ++j) {
        painter.paint({field.row(j), static_cast<std::size_t>(layout.width)}, &image.at(0, j));
    }
    return image;
}

void paint(std::span<const float> values, ValueRange range, const Palette& palette,
           std::span<Colour> colours) {
    CHECK(values.size() == colours.size(), "each value gets a colour");
    PalettePainter(range, palette).paint(values, colours.data());
}

Image paint(const Field& red, const Field& green, const Field& blue, Image earlier) {
    const PlaneLayout& layout = red.layout();
    CHECK(layout == green.layout() && layout == blue.layout(),
          "the three channels of a picture have one layout");
    Image image = unpainted(layout, std::move(earlier));
    for (std::int64_t j = 0; j < layout.height; ++j) {
        const float *r = red.row(j), *g = green.row(j), *b = blue.row(j);
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const bool is_nan = std::isnan(r[i]) || std::isnan(g[i]) || std::isnan(b[i]);
            const auto shown = [](float value) { return std::clamp(value, 0.0F, 1.0F); };
            image.at(i, j) = is_nan ? colour_of_nan : Colour{shown(r[i]), shown(g[i]), shown(b[i])};
        }
    }
    return image;
}

void clear_where_nan(Image& image, const Field& field) {
    CHECK(image.width == field.layout().width && image.height == field.layout().height,
          "a picture and its field have the same cells");
    for (std::int64_t j = 0; j < image.height; ++j) {
        const float* const row = field.row(j);
        for (std::int64_t i = 0; i < image.width; ++i) {
            if (std::isnan(row[i])) image.at(i, j) = transparent;
        }
    }
}

Image enlarge(Image image, int factor) {
    CHECK(factor >= 1, "a picture is enlarged by a whole factor of at least 1");
    if (factor == 1) return image;
    Image large(image.width * factor, image.height * factor);
    const auto enlarge_rows = [&](const auto& one, auto& all) {
        auto out = all.begin();
        for (std::int64_t y = 0; y < large.height; ++y) {
            const auto row = one.begin() + y / factor * image.width;
            for (std::int64_t x = 0; x < image.width; ++x) out = std::fill_n(out, factor, row[x]);
        }
    };
    enlarge_rows(image.pixels, large.pixels);
    if (!image.alpha.empty()) {
        large.alpha.resize(large.pixels.size());
        enlarge_rows(image.alpha, large.alpha);
    }
    return large;
}

Image repeated(const Image& image, int across, int down) {
    Image whole(image.width * across, image.height * down);
    const auto repeat = [&](const auto& one, auto& all) {
        for (std::int64_t y = 0; y < whole.height; ++y) {
            const auto row = one.begin() + y % image.height * image.width;
            for (int k = 0; k < across; ++k) {
                std::copy_n(row, image.width, all.begin() + y * whole.width + k * image.width);
            }
        }
    };
    repeat(image.pixels, whole.pixels);
    if (!image.alpha.empty()) {
        whole.alpha.resize(whole.pixels.size());
        repeat(image.alpha, whole.alpha);
    }
    return whole;
}

}  // namespace cascade
