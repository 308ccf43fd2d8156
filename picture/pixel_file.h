// Stores the pixels of a picture as bytes for pages in a browser, which cannot read PNG files.
#pragma once

#include "picture/grey_picture.h"

#include <string>
#include <string_view>

namespace cascade {

/// Prints one channel of a picture: "CASPIXEL", then channel, width and height in 8 bytes each,
/// then the values in binary32. All numbers have the machine's byte order, which is the same for
/// browsers and x86-64. A file has one or more such channels, one after another.
std::string print_pixel_file(const GreyPicture& picture,
                             PictureChannel channel = PictureChannel::lightness);
/// Fails if the file is damaged or does not contain the channel.
Result<GreyPicture> parse_pixel_file(std::string_view bytes,
                                     PictureChannel channel = PictureChannel::lightness);

}  // namespace cascade
