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

inline constexpr Colour pure_white{1, 1, 1};

/// A pixel that shows the background. All its channels are NaN.
inline constexpr Colour transparent{std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::quiet_NaN()};
inline bool is_transparent(const Colour& pixel) { return std::isnan(pixel[0]); }

/// An image in rows from the top. Each pixel has three numbers (sRGB, 0 … 1) or is `transparent`.
struct Image {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::vector<Colour> pixels;
    /// The opacity of each pixel, 0 … 1. Colours are not multiplied by the opacity, as in PNG
    /// files. Empty if all pixels are opaque or `transparent`.
    std::vector<float> alpha = {};

    Image() = default;
    Image(std::int64_t w, std::int64_t h, Colour fill = pure_white)
        : width(w), height(h), pixels(static_cast<std::size_t>(w * h), fill) {}
    Colour& at(std::int64_t x, std::int64_t y) {
        return pixels[static_cast<std::size_t>(y * width + x)];
    }
    const Colour& at(std::int64_t x, std::int64_t y) const {
        return pixels[static_cast<std::size_t>(y * width + x)];
    }
    float& alpha_at(std::int64_t x, std::int64_t y) {
        return alpha[static_cast<std::size_t>(y * width + x)];
    }
    /// The opacity of a pixel, 0 … 1. 0 if the pixel is `transparent`.
    float opacity(std::int64_t x, std::int64_t y) const {
        if (is_transparent(at(x, y))) return 0;
        return alpha.empty() ? 1 : alpha[static_cast<std::size_t>(y * width + x)];
    }
    /// The colour of a pixel in front of the colour `ground`. Colours are blended in sRGB, as in
    /// other programs.
    Colour over(const Colour& ground, std::int64_t x, std::int64_t y) const {
        const float part = opacity(x, y);
        if (part == 1) return at(x, y);
        Colour sum = ground;
        if (part == 0) return sum;
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += part * (at(x, y)[c] - sum[c]);
        return sum;
    }
};

/// The values that the two ends of a palette represent.
struct ValueRange {
    float low = 0;
    float high = 1;
    bool operator==(const ValueRange&) const = default;
};

/// The spread of a plane's finite values.
Spread spread_of(const Field& field);

/// The default range for drawing values: the smallest and the largest. If the values differ only by
/// rounding errors, low = high, so that rounding errors are not amplified. [0, 0] if there are no
/// values.
ValueRange automatic_range(const Spread& values);

/// The position of a value in a range: from 0 at `low` to 1 at `high`, and ½ if low = high. NaN
/// stays NaN.
double position_in(ValueRange range, float value);

/// Draws a field with a palette. Values outside of the range get the colour of the nearest end, and
/// NaN becomes magenta. If low = high, all values get the middle of the palette. If low > high, the
/// palette is reversed. The image may reuse the memory of `earlier`.
Image paint(const Field& field, ValueRange range, const Palette& palette, Image earlier = {});

/// Computes the colour of each value by a palette.
void paint(std::span<const float> values, ValueRange range, const Palette& palette,
           std::span<Colour> colours);

/// Draws three fields of the same layout as red, green and blue, clamped to 0 … 1. A pixel is
/// magenta if one of its values is NaN.
Image paint(const Field& red, const Field& green, const Field& blue, Image earlier = {});

/// The arguments of paint(), for a picture that has not been drawn yet.
struct Painting {
    const Field& field;
    ValueRange range;
    const Palette& palette;

    /// Whether the range is finite and the palette goes from one grey to another, both within 0 …
    /// 1.
    bool has_two_greys() const;
};

/// Makes pixels transparent if their cells are NaN in `field`, because such cells are outside the
/// domain. `field` must have as many columns and rows as the image.
void clear_where_nan(Image& image, const Field& field);

/// Replaces every pixel with a square of `factor` × `factor` pixels. `factor` is at least 1.
Image enlarge(Image image, int factor);

/// Makes an image with `down` rows of `across` copies of `image`. Both numbers must be at least 1.
Image repeated(const Image& image, int across, int down);

enum class PngDepth { eight = 8, sixteen = 16 };

/// The text chunks of a PNG file, each with its keyword. A keyword has 1 to 79 printable ASCII
/// characters, without leading, trailing or double blanks. Texts are UTF-8 (iTXt).
using PngTexts = std::map<std::string, std::string>;

/// The largest total size of a picture's texts in bytes, for writing and for reading.
inline constexpr std::size_t longest_png_text = std::size_t{16} << 20;

/// The meaning of the numbers in a PNG file. The numbers are either colours in sRGB, which the file
/// then declares, or the numbers of a map, to which readers must not apply colour correction.
enum class PngMeaning { colours, numbers };

/// The effort that is spent on compression. `fast` takes a third of the time of `small`, but makes
/// the files of patterns a tenth larger.
enum class PngEffort { small, fast };

/// Encodes a PNG file in memory, in the format that write_png() describes. Fails if a side is 0 or
/// above 2^31 − 1, if texts are too long or contain a NUL, or if memory is exhausted.
Result<std::string> encode_png(const Image& image, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning = PngMeaning::colours,
                               PngEffort effort = PngEffort::small);

/// Encodes the image that paint() would draw. If has_two_greys() is true, encodes the greys without
/// drawing an image, which halves the time.
Result<std::string> encode_png(const Painting& painting, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning = PngMeaning::colours,
                               PngEffort effort = PngEffort::small);

/// Writes a PNG file atomically. If all pixels are grey, it is a greyscale file. It has an alpha
/// channel only if `image.alpha` is not empty or some pixels are `transparent`. Pixels that are
/// `transparent` become white with alpha 0. Colours are rounded to 256 or 65536 values. Long texts
/// are compressed. Fails like encode_png() and write_file().
Result<void> write_png(const std::filesystem::path& path, const Image& image, PngDepth depth,
                       const PngTexts& texts);

/// Reads the text chunks (tEXt, zTXt, iTXt) of a PNG file in memory, without decoding the picture.
/// Latin-1 is converted to UTF-8. If several texts have the same keyword, the first one is used.
/// Fails if the data is not a PNG file, if it is incomplete or damaged (checksums are verified), or
/// if its texts are too long.
Result<PngTexts> parse_png_texts(std::string_view bytes);

/// Reads the text chunks of a PNG file.
Result<PngTexts> read_png_texts(const std::filesystem::path& path);

/// A picture of a contact sheet, and its label.
struct Panel {
    std::string label;
    Image image;
};

/// Draws a contact sheet with `columns` panels in each row. Labels are in a small built-in font
/// (ASCII only, other characters become boxes). A label that is too long is cut off and ends in
/// "…". The sheet is visible through transparent pixels. All pictures are enlarged by the same
/// integer, so that small pictures are legible. A picture with only a few rows is stretched to a
/// band.
Image make_sheet(std::span<const Panel> panels, int columns);

/// Draws an image for a terminal with half-block characters and 24-bit colour. The result is at
/// most `columns` wide. A wider image is reduced in proportion by averaging, and a narrower image
/// is not enlarged. Pixels that are less than half opaque show the terminal's background. Each line
/// ends with a reset of the colours and a line break.
std::string half_blocks(const Image& image, int columns);

/// Draws an image with plain characters from dark to light, " .:-=+*#%@", for pipes and for
/// terminals without colours. Each character shows two pixels, one above the other. It is a space
/// if the pixels are less than half opaque.
std::string plain_characters(const Image& image, int columns);

}  // namespace cascade
