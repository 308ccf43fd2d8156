// A header of 24 bytes and the values.
#include "picture/pixel_file.h"

#include <cstring>

namespace cascade {
namespace {

constexpr std::string_view pixel_magic = "CASPIXEL";
constexpr std::size_t pixel_header_bytes = 24;

}  // namespace

std::string print_pixel_file(const GreyPicture& picture) {
    std::string bytes(pixel_magic);
    for (const std::int64_t side : {picture.width, picture.height}) {
        bytes.append(reinterpret_cast<const char*>(&side), sizeof side);
    }
    return bytes.append(reinterpret_cast<const char*>(picture.values.data()),
                        picture.values.size() * sizeof(float));
}

Result<GreyPicture> parse_pixel_file(std::string_view bytes) {
    if (!bytes.starts_with(pixel_magic) || bytes.size() < pixel_header_bytes) {
        return failure("it is no file of pixels");
    }
    GreyPicture picture;
    std::memcpy(&picture.width, bytes.data() + pixel_magic.size(), 8);
    std::memcpy(&picture.height, bytes.data() + pixel_magic.size() + 8, 8);
    const std::size_t pixels = (bytes.size() - pixel_header_bytes) / sizeof(float);
    const auto count = static_cast<std::int64_t>(pixels);
    if (picture.width < 1 || picture.height < 1 || picture.width > count ||
        picture.height != count / picture.width || count % picture.width != 0 ||
        bytes.size() != pixel_header_bytes + pixels * sizeof(float)) {
        return failure("its size is not what it says");
    }
    picture.values.resize(pixels);
    std::memcpy(picture.values.data(), bytes.data() + pixel_header_bytes, pixels * sizeof(float));
    return picture;
}

}  // namespace cascade
