// Drawing of fields as images: ranges, palettes, enlargement.
#include "core/check.h"
#include "picture/image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cascade {
/// Computed in double, so that no range overflows.
double position_in(ValueRange range, float value) {
    if (std::isnan(value)) return std::numeric_limits<double>::quiet_NaN();
    const double low = static_cast<double>(range.low);
    const double width = static_cast<double>(range.high) - low;
    if (width == 0) return 0.5;
    return (static_cast<double>(value) - low) / width;
}

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
    if (values.is_even()) {
        const auto middle = static_cast<float>(values.mean);
        return {middle, middle};
    }
    return {static_cast<float>(values.smallest), static_cast<float>(values.largest)};
}

Image paint(const Field& field, ValueRange range, const Palette& palette) {
    const PlaneLayout& layout = field.layout();
    Image image(layout.width, layout.height);
    for (std::int64_t j = 0; j < layout.height; ++j) {
        const float* row = field.row(j);
        for (std::int64_t i = 0; i < layout.width; ++i) {
            image.at(i, j) = colour_at(palette, position_in(range, row[i]));
        }
    }
    return image;
}

Image paint(const Field& red, const Field& green, const Field& blue) {
    const PlaneLayout& layout = red.layout();
    CHECK(layout == green.layout() && layout == blue.layout(),
          "the three channels of a picture have one layout");
    Image image(layout.width, layout.height);
    for (std::int64_t j = 0; j < layout.height; ++j) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const Colour values{red.at(i, j), green.at(i, j), blue.at(i, j)};
            Colour& pixel = image.at(i, j);
            if (std::any_of(values.begin(), values.end(), [](float v) { return std::isnan(v); })) {
                pixel = colour_of_nan;
                continue;
            }
            std::transform(values.begin(), values.end(), pixel.begin(),
                           [](float value) { return std::clamp(value, 0.0F, 1.0F); });
        }
    }
    return image;
}

void clear_where_nan(Image& image, const Field& field) {
    CHECK(image.width == field.layout().width && image.height == field.layout().height,
          "a picture and its field have the same cells");
    for (std::int64_t j = 0; j < image.height; ++j) {
        for (std::int64_t i = 0; i < image.width; ++i) {
            if (std::isnan(field.at(i, j))) image.at(i, j) = transparent;
        }
    }
}

Image enlarge(Image image, int factor) {
    CHECK(factor >= 1, "a picture is enlarged by a whole factor of at least 1");
    if (factor == 1) return image;
    Image large(image.width * factor, image.height * factor);
    for (std::int64_t y = 0; y < large.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            std::fill_n(&large.at(x * factor, y), factor, image.at(x, y / factor));
        }
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
