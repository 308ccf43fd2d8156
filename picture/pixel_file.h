// The pixels of a picture as bytes, for pages that carry pictures but no reader of PNG files.
#pragma once

#include "picture/grey_picture.h"

#include <string>
#include <string_view>

namespace cascade {

/// "CASPIXEL", width and height in 8 bytes each, then the values in binary32, all in the byte order
/// of the machine; browsers have that of x86-64.
std::string print_pixel_file(const GreyPicture& picture);
Result<GreyPicture> parse_pixel_file(std::string_view bytes);

}  // namespace cascade
