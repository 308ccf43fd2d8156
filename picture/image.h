// Images and PNG files.
#pragma once

#include "core/palette.h"
#include "core/plane.h"
#include "core/result.h"
#include "core/spread.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// What a pixel holds that shows whatever lies behind the picture: no channel is a number.
inline constexpr Colour transparent{std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::quiet_NaN()};
inline bool is_transparent(const Colour& pixel) { return std::isnan(pixel[0]); }

/// A picture, rows from the top, three numbers (sRGB, 0 … 1) a pixel, or `transparent`.
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

/// Of the finite values of the cells of a plane.
Spread spread_of(const Field& field);

/// The range in which values are drawn where no other range is given: their smallest and their
/// largest. Of values that are even it has no width, lest rounding be drawn in black and white; [0,
/// 0] where there is no value.
ValueRange automatic_range(const Spread& values);

/// Where a value lies between the ends of a range: 0 at the low one, 1 at the high one, and ½ in a
/// range of no width. NaN stays NaN.
double position_in(ValueRange range, float value);

/// A field through a palette. A range of no width gives the palette's middle, a range whose ends
/// are swapped the palette from its end to its start. Values beyond the range get the colour of
/// its end, NaN magenta.
Image paint(const Field& field, ValueRange range, const Palette& palette);

/// Three fields of one layout as red, green, blue, clamped to 0 … 1; magenta where one is NaN.
Image paint(const Field& red, const Field& green, const Field& blue);

/// Makes every pixel transparent whose cell of `field` is NaN: a picture of the domain alone, where
/// `field` is NaN outside of it. Both have the same columns and rows.
void clear_where_nan(Image& image, const Field& field);

/// Every pixel as a square of `factor` pixels (at least 1).
Image enlarge(Image image, int factor);

enum class PngDepth { eight = 8, sixteen = 16 };

/// Text chunks of a PNG by keyword (printable ASCII, 1 to 79 characters, no blank at the ends or
/// twice in a row). Values are UTF-8 (iTXt).
using PngTexts = std::map<std::string, std::string>;

/// The most that the texts of a picture have together, in bytes, written or read.
inline constexpr std::size_t longest_png_text = std::size_t{16} << 20;

/// What the levels of a PNG file are: colours in sRGB, as the file then says, or numbers of a map
/// that no reader may bend.
enum class PngMeaning { colours, numbers };

/// A PNG file in memory, as write_png writes it. Fails where a side is 0 or above 2^31 − 1, texts
/// are too long or hold a NUL, or memory is short.
Result<std::string> encode_png(const Image& image, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning = PngMeaning::colours);

/// Writes atomically: a file of that name is replaced only by a complete one. A picture whose
/// pixels are all grey is written as greyscale; where one is transparent there is an alpha channel,
/// and such pixels are white with alpha 0. Colours are rounded to the nearest of 256 or 65536
/// levels; long texts are compressed. Fails as encode_png and write_file do.
Result<void> write_png(const std::filesystem::path& path, const Image& image, PngDepth depth,
                       const PngTexts& texts);

/// The text chunks (tEXt, zTXt, iTXt) of a PNG file in memory; Latin-1 becomes UTF-8, of a keyword
/// used twice the first text stays. The picture itself is not decoded. Fails, with the reason, on
/// what is no PNG, is cut off, damaged (checksums are looked at) or has texts above the limit.
Result<PngTexts> parse_png_texts(std::string_view bytes);

/// The same of a file.
Result<PngTexts> read_png_texts(const std::filesystem::path& path);

/// One picture of a sheet with the line written under it.
struct Panel {
    std::string label;
    Image image;
};

/// A contact sheet: panels in rows of `columns`, labels in a small font of our own (ASCII; another
/// character is drawn as a box, a label that is too long ends in "…"). What is transparent shows
/// the sheet. All panels are enlarged by one whole factor, so that small ones can be seen; a
/// picture of a few rows is drawn as a band.
Image make_sheet(std::span<const Panel> panels, int columns);

/// The picture in half-block characters and 24-bit colour, at most `columns` wide, for terminals.
/// A wider picture is averaged down in its own proportions, none is enlarged. What is transparent
/// shows the terminal's own ground. Each line ends in a
/// reset of the colours and a line end.
std::string half_blocks(const Image& image, int columns);

/// The same in plain characters from dark to light, " .:-=+*#%@", each for two pixels one above the
/// other: for pipes, and for terminals without colours. What is transparent is a space.
std::string plain_characters(const Image& image, int columns);

}  // namespace cascade
