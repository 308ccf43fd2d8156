// Pictures as numbers: what `image("f.png")` reads.
#pragma once

#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace cascade {

/// The lightness of a picture's pixels, rows from the top, 0 (black) … 1 (white).
struct GreyPicture {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::vector<float> values;
};

/// The most pixels that are read.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

/// The picture of a PNG file in memory: grey, colour, palette; 1 to 16 bits; interlaced or not. The
/// stored levels are used as they are, whatever gamma the file names. A colour becomes 0.2126 red +
/// 0.7152 green + 0.0722 blue (the luma of ITU-R BT.709); what is transparent shows white behind
/// it. Fails, with the reason, on what is no PNG, is cut off or damaged, or has too many pixels.
/// The message is a clause that follows "cannot read 'FILE': ".
Result<GreyPicture> parse_grey_picture(std::string_view bytes);

/// The largest PNG file that is read for its pixels, in bytes.
inline constexpr std::uint64_t largest_picture_file = std::uint64_t{1} << 30;

/// The same of a file.
Result<GreyPicture> read_grey_picture(const std::filesystem::path& path);

/// The picture with other sides, each axis by itself: where pixels become fewer, the mean over the
/// area of each new one; where they become more, linear between the middles of pixels.
GreyPicture resized(const GreyPicture& picture, std::int64_t width, std::int64_t height);

/// A picture of the grid's columns and rows as a field, the same in every slice; the halo is zero.
Field to_field(const GreyPicture& picture, const Grid& grid);

}  // namespace cascade
