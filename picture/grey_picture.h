// Pictures as numbers, as read by `image("f.png")` and `image("f.png", "red")`.
#pragma once

#include "core/picture_channel.h"
#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace cascade {

/// One number per pixel of a picture, rows from the top, from 0 to 1.
struct GreyPicture {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::vector<float> values;
};

/// The largest number of pixels that is read.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

/// The picture in a PNG file in memory: grey, colour or palette; 1 to 16 bits; interlaced or not.
/// Stored levels are used unchanged, ignoring the file's gamma. A colour becomes 0.2126 red +
/// 0.7152 green + 0.0722 blue (the luma of ITU-R BT.709), and transparency is blended with white.
/// The other channels are read as stored: a grey picture has its grey in all three colours, and
/// alpha is 1 if the file has none. Fails if the data is no PNG, truncated or damaged, or has too
/// many pixels. The message is a clause that follows "cannot read 'FILE': ".
Result<GreyPicture> parse_grey_picture(std::string_view bytes,
                                       PictureChannel channel = PictureChannel::lightness);

/// The largest PNG file, in bytes, that is read for its pixels.
inline constexpr std::uint64_t largest_picture_file = std::uint64_t{1} << 30;

/// The same for a file.
Result<GreyPicture> read_grey_picture(const std::filesystem::path& path);

/// Resamples a picture along each axis separately: by the mean over the area of each new pixel to
/// reduce, by linear interpolation between pixel centres to enlarge.
GreyPicture resized(const GreyPicture& picture, std::int64_t width, std::int64_t height);

/// A picture of the grid's columns and rows as a field, the same in every slice, with a zero halo.
Field to_field(const GreyPicture& picture, const Grid& grid);

}  // namespace cascade
