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

/// A pixel that shows the background: all channels are NaN.
inline constexpr Colour transparent{std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::quiet_NaN()};
inline bool is_transparent(const Colour& pixel) { return std::isnan(pixel[0]); }

/// An image, rows from the top, with three numbers (sRGB, 0 … 1) per pixel, or `transparent`.
struct Image {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::vector<Colour> pixels;
    /// The opacity of each pixel, 0 … 1, not multiplied into its colour, as in PNG files. Empty if
    /// all pixels are opaque, except `transparent` ones.
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
    /// 0 … 1.
    float opacity(std::int64_t x, std::int64_t y) const {
        if (is_transparent(at(x, y))) return 0;
        return alpha.empty() ? 1 : alpha[static_cast<std::size_t>(y * width + x)];
    }
    /// The pixel on a ground of this colour, blended in sRGB, as other programs do.
    Colour over(const Colour& ground, std::int64_t x, std::int64_t y) const {
        const float part = opacity(x, y);
        if (part == 1) return at(x, y);
        Colour sum = ground;
        if (part == 0) return sum;
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += part * (at(x, y)[c] - sum[c]);
        return sum;
    }
};

/// The values that map to a palette's ends.
struct ValueRange {
    float low = 0;
    float high = 1;
    bool operator==(const ValueRange&) const = default;
};

/// The spread of the finite cell values of a plane.
Spread spread_of(const Field& field);

/// The default range for drawing values: their smallest and largest. For uniform values it has no
/// width, so that rounding errors are not amplified. [0, 0] without values.
ValueRange automatic_range(const Spread& values);

/// The position of a value in a range, 0 … 1 inside, and ½ in a range of no width. NaN stays NaN.
double position_in(ValueRange range, float value);

/// Draws a field with a palette. A range of no width gives the palette's middle. A range with
/// swapped ends reverses the palette. Values beyond an end of the range get its colour, NaN
/// magenta. The image may reuse the memory of an earlier one.
Image paint(const Field& field, ValueRange range, const Palette& palette, Image earlier = {});

/// The same for any values, one colour each.
void paint(std::span<const float> values, ValueRange range, const Palette& palette,
           std::span<Colour> colours);

/// Three fields of one layout as red, green and blue, clamped to 0 … 1; magenta if one is NaN.
Image paint(const Field& red, const Field& green, const Field& blue, Image earlier = {});

/// The arguments of paint(), not yet drawn.
struct Painting {
    const Field& field;
    ValueRange range;
    const Palette& palette;

    /// True if the palette goes from a grey to another, both from 0 to 1, and the range is finite.
    bool has_two_greys() const;
};

/// Makes pixels transparent if their cell of `field`, which has the same columns and rows, is NaN,
/// that is, outside the domain.
void clear_where_nan(Image& image, const Field& field);

/// Replaces every pixel by a square of `factor` × `factor` pixels, factor ≥ 1.
Image enlarge(Image image, int factor);

/// The image repeated `across` times in each of `down` rows. Both are at least 1.
Image repeated(const Image& image, int across, int down);

enum class PngDepth { eight = 8, sixteen = 16 };

/// Text chunks of a PNG by keyword (printable ASCII, 1 to 79 characters, no leading, trailing or
/// double blanks). Values are UTF-8 (iTXt).
using PngTexts = std::map<std::string, std::string>;

/// The largest total size of a picture's texts, in bytes, written or read.
inline constexpr std::size_t longest_png_text = std::size_t{16} << 20;

/// The meaning of a PNG file's levels: colours in sRGB, as the file then declares, or numbers of a
/// map, which readers must not colour-correct.
enum class PngMeaning { colours, numbers };

/// `fast` takes a third of the time and makes files of patterns a tenth larger.
enum class PngEffort { small, fast };

/// A PNG file in memory, as write_png writes it. Fails if a side is 0 or above 2^31 − 1, if texts
/// are too long or contain a NUL, or if memory runs out.
Result<std::string> encode_png(const Image& image, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning = PngMeaning::colours,
                               PngEffort effort = PngEffort::small);

/// The same file as for the image that paint() draws. With two greys it is made without an image,
/// in half of the time.
Result<std::string> encode_png(const Painting& painting, PngDepth depth, const PngTexts& texts,
                               PngMeaning meaning = PngMeaning::colours,
                               PngEffort effort = PngEffort::small);

/// Writes a PNG file atomically. A picture with only grey pixels is written as greyscale. Only
/// `alpha` and transparent pixels cause an alpha channel. Transparent ones are white with alpha 0.
/// Colours are rounded to 256 or 65536 levels. Long texts are compressed. Fails as encode_png and
/// write_file do.
Result<void> write_png(const std::filesystem::path& path, const Image& image, PngDepth depth,
                       const PngTexts& texts);

/// The text chunks (tEXt, zTXt, iTXt) of a PNG file in memory. Latin-1 becomes UTF-8. The first of
/// several texts with the same keyword is used. Does not decode the picture. Fails if the data is
/// no PNG, truncated, damaged (checksums are verified) or has texts above the limit.
Result<PngTexts> parse_png_texts(std::string_view bytes);

/// The same for a file.
Result<PngTexts> read_png_texts(const std::filesystem::path& path);

/// A picture of a contact sheet with its label.
struct Panel {
    std::string label;
    Image image;
};

/// A contact sheet: panels in rows of `columns`, labelled in a small built-in font (ASCII; other
/// characters are drawn as a box, and a label that is too long ends in "…"). The sheet shows
/// through transparent pixels. All panels are enlarged by a common integral factor so that small
/// ones are visible. A picture of a few rows is drawn as a band.
Image make_sheet(std::span<const Panel> panels, int columns);

/// The picture in half-block characters and 24-bit colour for terminals, at most `columns` wide.
/// Wider pictures are averaged down in proportion. None is enlarged. Pixels that are less than half
/// opaque show the terminal's background. Each line ends with a reset of the colours and a line
/// end.
std::string half_blocks(const Image& image, int columns);

/// The same in plain characters from dark to light, " .:-=+*#%@", one for two vertically adjacent
/// pixels, for pipes and for terminals without colours. Pixels that are less than half opaque are
/// spaces.
std::string plain_characters(const Image& image, int columns);

}  // namespace cascade
