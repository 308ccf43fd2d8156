// Pictures as arrays of numbers, for `image("f.png")` and `image("f.png", "red")` in scripts.
#pragma once

#include "core/picture_channel.h"
#include "core/plane.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace cascade {

/// One number from 0 to 1 for each pixel of a picture, in rows from the top.
struct GreyPicture {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::vector<float> values;
};

/// The largest number of pixels that a picture may have.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

/// Reads a PNG file in memory. The file may be grey, in colour or with a palette, have 1 to 16
/// bits, and be interlaced. The stored numbers are used as they are, without applying the file's
/// gamma. The lightness of a colour is 0.2126 red + 0.7152 green + 0.0722 blue (the luma of ITU-R
/// BT.709), with transparent pixels blended with white. The other channels are read as they are
/// stored. A grey picture has its grey in all three colours, and alpha is 1 if the file has no
/// alpha. Fails if the data is not a PNG file, is incomplete or damaged, or has too many pixels.
/// The message is a clause that continues "cannot read 'FILE': ".
Result<GreyPicture> parse_grey_picture(std::string_view bytes,
                                       PictureChannel channel = PictureChannel::lightness);

/// The largest PNG file that is read as a picture, in bytes.
inline constexpr std::uint64_t largest_picture_file = std::uint64_t{1} << 30;

/// Reads a PNG file. See parse_grey_picture().
Result<GreyPicture> read_grey_picture(const std::filesystem::path& path);

/// Resamples a picture along each axis separately. Along an axis with fewer pixels than before, a
/// new pixel has the mean over its length. Along an axis with more pixels, values are interpolated
/// linearly between the centres of pixels.
GreyPicture resized(const GreyPicture& picture, std::int64_t width, std::int64_t height);

/// Converts a picture to a field. The picture must have as many columns and rows as the grid. Every
/// slice gets the same values. The halo is 0.
Field to_field(const GreyPicture& picture, const Grid& grid);

}  // namespace cascade
