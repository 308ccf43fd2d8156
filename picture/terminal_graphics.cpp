// The protocols are defined in https://sw.kovidgoyal.net/kitty/graphics-protocol/, and in DEC,
// "VT330/VT340 Programmer Reference Manual", volume 2, 1988, chapter 14.
#include "picture/terminal_graphics.h"

#include "core/base64.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

namespace cascade {
namespace {

using Bytes = std::array<std::uint8_t, 3>;

/// The colour with its channels rounded to `levels` + 1 values.
Bytes rounded(const Colour& colour, int levels) {
    Bytes bytes{};
    std::transform(colour.begin(), colour.end(), bytes.begin(), [&](float value) {
        const float level = value > 0 ? std::min(value, 1.0F) * static_cast<float>(levels) : 0;
        return static_cast<std::uint8_t>(level + 0.5F);
    });
    return bytes;
}

constexpr int most_colours = 256;
constexpr std::int16_t no_colour = -1;

struct Indexed {
    std::map<Bytes, std::int16_t> colours;
    int levels = 0;
    std::vector<std::int16_t> pixels;
};

/// Rounds each channel to `levels` + 1 values. Fills `indexed` with the resulting colours and the
/// index of each pixel's colour. Returns false if there are too many colours.
bool index(const Image& image, int levels, Indexed& indexed) {
    indexed.colours.clear();
    indexed.pixels.clear();
    indexed.levels = levels;
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            if (image.opacity(x, y) < 0.5F) {
                indexed.pixels.push_back(no_colour);
                continue;
            }
            const auto next = static_cast<std::int16_t>(indexed.colours.size());
            const auto [colour, is_new] =
                indexed.colours.emplace(rounded(image.at(x, y), levels), next);
            if (is_new && next == most_colours) return false;
            indexed.pixels.push_back(colour->second);
        }
    }
    return true;
}

/// Appends `count` times the character for a group of six pixels in a column. The bits of `rows`
/// tell which of these pixels have the colour.
void append_run(std::string& out, int rows, std::int64_t count) {
    const char sixel = static_cast<char>('?' + rows);
    if (count > 3) out += fmt::format("!{}{}", count, sixel);
    else out.append(static_cast<std::size_t>(count), sixel);
}

void append_band(std::string& out, const Image& image, const Indexed& indexed, std::int64_t top) {
    const std::int64_t bottom = std::min(top + 6, image.height);
    const auto pixel = [&](std::int64_t x, std::int64_t y) {
        return indexed.pixels[static_cast<std::size_t>(y * image.width + x)];
    };
    std::array<bool, most_colours> is_used{};
    for (std::int64_t y = top; y < bottom; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            if (pixel(x, y) != no_colour) is_used[static_cast<std::size_t>(pixel(x, y))] = true;
        }
    }
    for (std::int16_t colour = 0; colour < most_colours; ++colour) {
        if (!is_used[static_cast<std::size_t>(colour)]) continue;
        out += fmt::format("#{}", colour);
        int rows = 0;
        std::int64_t count = 0;
        for (std::int64_t x = 0; x < image.width; ++x) {
            int here = 0;
            for (std::int64_t y = top; y < bottom; ++y) {
                if (pixel(x, y) == colour) here |= 1 << (y - top);
            }
            if (here != rows) {
                append_run(out, rows, count);
                count = 0;
            }
            rows = here;
            ++count;
        }
        if (rows != 0) append_run(out, rows, count);
        out += '$';  // This goes back to the first column.
    }
    out += '-';
}

}  // namespace

std::string kitty_picture(const Image& image, std::optional<std::uint32_t> id) {
    const auto png = encode_png(image, PngDepth::eight, {}, PngMeaning::colours, PngEffort::fast);
    if (!png) return "";
    const std::string data = base64(*png);
    constexpr std::size_t longest_chunk = 4096;
    std::string out;
    for (std::size_t at = 0; at < data.size(); at += longest_chunk) {
        const bool is_last = at + longest_chunk >= data.size();
        out += "\x1b_G";
        if (at == 0) out += "f=100,a=T,C=1,q=2,";
        if (at == 0 && id) out += fmt::format("i={},", *id);
        out += fmt::format("m={:d};{}\x1b\\", !is_last, data.substr(at, longest_chunk));
    }
    return out;
}

std::string without_kitty_picture(std::uint32_t id) {
    return fmt::format("\x1b_Ga=d,d=I,i={},q=2\x1b\\", id);
}

std::string sixel_picture(const Image& image) {
    Indexed indexed;
    for (const int levels : {255, 127, 63, 31, 15, 7, 5}) {
        if (index(image, levels, indexed)) break;
    }
    // Pixels without a colour keep the background. Pixels are square.
    std::string out = fmt::format("\x1bP0;1;0q\"1;1;{};{}", image.width, image.height);
    for (const auto& [colour, number] : indexed.colours) {
        const auto percent = [&](std::size_t c) {
            return (100 * colour[c] + indexed.levels / 2) / indexed.levels;
        };
        out += fmt::format("#{};2;{};{};{}", number, percent(0), percent(1), percent(2));
    }
    for (std::int64_t top = 0; top < image.height; top += 6) {
        append_band(out, image, indexed, top);
    }
    return out + "\x1b\\";
}

}  // namespace cascade
