// Images and PNG files.
#pragma once

#include "core/palette.h"
#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// A picture, rows from the top, three numbers (sRGB, 0 … 1) a pixel.
struct Image {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::vector<Colour> pixels;

    Image() = default;
    Image(std::int64_t w, std::int64_t h, Colour fill = {1, 1, 1})
        : width(w), height(h), pixels(static_cast<std::size_t>(w * h), fill) {}
    Colour& at(std::int64_t x, std::int64_t y) {
        return pixels[static_cast<std::size_t>(y * width + x)];
    }
    const Colour& at(std::int64_t x, std::int64_t y) const {
        return pixels[static_cast<std::size_t>(y * width + x)];
    }
};

/// The values that become a palette's ends.
struct ValueRange {
    float low = 0;
    float high = 1;
};

/// Smallest and largest finite value; [0, 0] where there is none.
ValueRange value_range(const Field& field);

/// A field through a palette. A range of no width gives the palette's middle.
Image paint(const Field& field, ValueRange range, const Palette& palette);

/// Three fields as red, green, blue, clamped to 0 … 1.
Image paint(const Field& red, const Field& green, const Field& blue);

/// Every pixel as a square of `factor` pixels.
Image enlarge(const Image& image, int factor);

enum class PngDepth { eight = 8, sixteen = 16 };

/// Text chunks of a PNG by keyword (Latin letters, at most 79). Values are UTF-8 (iTXt).
using PngTexts = std::map<std::string, std::string>;

/// Writes atomically: a file of that name is replaced only by a complete one. A picture whose
/// pixels are all grey is written as greyscale.
Result<void> write_png(const std::filesystem::path& path, const Image& image, PngDepth depth,
                       const PngTexts& texts);

/// The text chunks of a PNG file (tEXt, zTXt, iTXt). Fails on what is no PNG.
Result<PngTexts> read_png_texts(const std::filesystem::path& path);

/// One picture of a sheet with the line written under it.
struct Panel {
    std::string label;
    Image image;
};

/// A contact sheet: panels in rows of `columns`, labels in a small font of our own (ASCII).
Image make_sheet(std::span<const Panel> panels, int columns);

/// The picture in half-block characters and 24-bit colour, at most `columns` wide, for terminals.
std::string half_blocks(const Image& image, int columns);

}  // namespace cascade
