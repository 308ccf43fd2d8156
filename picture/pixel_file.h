// The pixels of a picture as bytes, for pages that have pictures but no reader of PNG files.
#pragma once

#include "picture/grey_picture.h"

#include <string>
#include <string_view>

namespace cascade {

/// One channel of a picture: "CASPIXEL", the channel's number, width and height in 8 bytes each,
/// then the values in binary32, all in the machine's byte order, which is the same in browsers as
/// on x86-64. A file has at least one channel.
std::string print_pixel_file(const GreyPicture& picture,
                             PictureChannel channel = PictureChannel::lightness);
/// Fails if the file is damaged or lacks the channel.
Result<GreyPicture> parse_pixel_file(std::string_view bytes,
                                     PictureChannel channel = PictureChannel::lightness);

}  // namespace cascade
