// Each character '▀' shows two vertically adjacent pixels: the upper pixel in the foreground
// colour, and the lower pixel in the background colour. Pixels are square, because characters are
// about twice as high as wide.
#include "core/check.h"
#include "picture/image.h"
#include "picture/terminal_graphics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>

namespace cascade {
namespace {

/// The length of the part of pixel k that is inside [from, to).
double overlap(std::int64_t k, double from, double to) {
    const auto left = static_cast<double>(k);
    return std::max(0.0, std::min(left + 1, to) - std::max(left, from));
}

/// The interval of pixels, along an axis with `size` pixels, that becomes pixel k of `parts` new
/// pixels.
struct Stretch {
    double from;
    double to;
    std::int64_t first;
    std::int64_t last;  ///< One after the last pixel.

    Stretch(std::int64_t k, std::int64_t parts, std::int64_t size)
        : from(static_cast<double>(k) * static_cast<double>(size) / static_cast<double>(parts)),
          to(static_cast<double>(k + 1) * static_cast<double>(size) / static_cast<double>(parts)),
          first(static_cast<std::int64_t>(from)),
          last(std::min(size, static_cast<std::int64_t>(std::ceil(to)))) {}
};

struct Average {
    Colour colour = transparent;
    double opacity = 0;
};

Average average(const Image& image, const Stretch& across, const Stretch& down) {
    std::array<double, 3> sum{};
    double weight_sum = 0, weight_seen = 0;
    for (std::int64_t y = down.first; y < down.last; ++y) {
        for (std::int64_t x = across.first; x < across.last; ++x) {
            const double weight =
                overlap(x, across.from, across.to) * overlap(y, down.from, down.to);
            weight_sum += weight;
            const double seen = weight * static_cast<double>(image.opacity(x, y));
            if (seen == 0) continue;
            weight_seen += seen;
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += seen * static_cast<double>(image.at(x, y)[c]);
            }
        }
    }
    if (weight_seen == 0) return {};
    Average result{{}, weight_seen / weight_sum};
    for (std::size_t c = 0; c < 3; ++c) result.colour[c] = static_cast<float>(sum[c] / weight_seen);
    return result;
}

/// Whether a pixel is drawn. Characters and sixels can only be drawn or left out as a whole.
bool is_seen(double opacity) { return opacity >= 0.5; }

}  // namespace

Image reduce(const Image& image, std::int64_t width) {
    const double factor = static_cast<double>(width) / static_cast<double>(image.width);
    const double height = std::round(static_cast<double>(image.height) * factor);
    Image small(width, std::max<std::int64_t>(1, static_cast<std::int64_t>(height)));
    for (std::int64_t y = 0; y < small.height; ++y) {
        const Stretch down(y, small.height, image.height);
        for (std::int64_t x = 0; x < width; ++x) {
            const Average mean = average(image, Stretch(x, width, image.width), down);
            const bool is_kept = !image.alpha.empty() || is_seen(mean.opacity);
            small.at(x, y) = is_kept ? mean.colour : transparent;
            if (!image.alpha.empty()) small.alpha.push_back(static_cast<float>(mean.opacity));
        }
    }
    return small;
}

namespace {

using Levels = std::array<int, 3>;

/// The levels of a colour; nullopt if the terminal's background is shown.
std::optional<Levels> bytes_of(const Colour& colour, double opacity) {
    if (!is_seen(opacity)) return std::nullopt;
    Levels bytes{};
    std::transform(colour.begin(), colour.end(), bytes.begin(), [](float value) {
        if (!(value > 0)) return 0;
        return static_cast<int>(std::min(value, 1.0F) * 255.0F + 0.5F);
    });
    return bytes;
}

/// Appends the escape sequence of a colour if it differs from the current one. `kind` is 38 for the
/// foreground and 48 for the background. nullopt stands for the terminal's own colour.
void set_colour(std::string& out, std::optional<Levels>& current,
                const std::optional<Levels>& wanted, int kind) {
    if (current == wanted) return;
    current = wanted;
    if (!wanted) {
        fmt::format_to(std::back_inserter(out), "\x1b[{}m", kind + 1);
        return;
    }
    fmt::format_to(std::back_inserter(out), "\x1b[{};2;{};{};{}m", kind, (*wanted)[0], (*wanted)[1],
                   (*wanted)[2]);
}

/// Draws one character for two pixels.
void draw_pair(std::string& out, std::optional<Levels>& ink, std::optional<Levels>& ground,
               const std::optional<Levels>& upper, const std::optional<Levels>& lower) {
    if (upper) {
        set_colour(out, ink, upper, 38);
        set_colour(out, ground, lower, 48);
        out += "\u2580";
        return;
    }
    if (lower) set_colour(out, ink, lower, 38);
    set_colour(out, ground, std::nullopt, 48);
    out += lower ? "\u2584" : " ";
}

}  // namespace

std::string half_blocks(const Image& image, int columns) {
    CHECK(columns >= 1, "a terminal has columns");
    if (image.width < 1 || image.height < 1) return {};
    if (image.width > columns) return half_blocks(reduce(image, columns), columns);
    std::string out;
    for (std::int64_t y = 0; y < image.height; y += 2) {
        std::optional<Levels> ink, ground;
        for (std::int64_t x = 0; x < image.width; ++x) {
            // If the number of rows is odd, the terminal's background is below the last row.
            const auto bytes = [&](std::int64_t row) -> std::optional<Levels> {
                if (row >= image.height) return std::nullopt;
                return bytes_of(image.at(x, row), static_cast<double>(image.opacity(x, row)));
            };
            draw_pair(out, ink, ground, bytes(y), bytes(y + 1));
        }
        out += "\x1b[0m\n";
    }
    return out;
}

std::string plain_characters(const Image& image, int columns) {
    CHECK(columns >= 1, "a terminal has columns");
    constexpr std::string_view ramp = " .:-=+*#%@";
    if (image.width < 1 || image.height < 1) return {};
    if (image.width > columns) return plain_characters(reduce(image, columns), columns);
    std::string out;
    for (std::int64_t y = 0; y < image.height; y += 2) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            const Stretch down(y / 2, (image.height + 1) / 2, image.height);
            const Average mean = average(image, Stretch(x, image.width, image.width), down);
            const std::optional<Levels> bytes = bytes_of(mean.colour, mean.opacity);
            const int light = bytes ? (*bytes)[0] + (*bytes)[1] + (*bytes)[2] : 0;
            out += ramp[static_cast<std::size_t>(light) * ramp.size() / (3 * 256)];
        }
        out += '\n';
    }
    return out;
}

}  // namespace cascade
