// Each channel has a header of 32 bytes.
#include "picture/pixel_file.h"

#include <array>
#include <cstring>

namespace cascade {
namespace {

constexpr std::string_view file_mark = "CASPIXEL";
using Header = std::array<std::int64_t, 3>;  ///< The channel, the width and the height.
constexpr std::size_t header_bytes = file_mark.size() + sizeof(Header);

}  // namespace

std::string print_pixel_file(const GreyPicture& picture, PictureChannel channel) {
    std::string bytes(file_mark);
    const Header header{static_cast<std::int64_t>(channel), picture.width, picture.height};
    bytes.append(reinterpret_cast<const char*>(header.data()), sizeof header);
    return bytes.append(reinterpret_cast<const char*>(picture.values.data()),
                        picture.values.size() * sizeof(float));
}

Result<GreyPicture> parse_pixel_file(std::string_view bytes, PictureChannel channel) {
    Result<GreyPicture> found = failure("it lacks a channel of the picture");
    do {
        if (!bytes.starts_with(file_mark) || bytes.size() < header_bytes) {
            return failure("it is not a file of pixels");
        }
        Header header;
        std::memcpy(header.data(), bytes.data() + file_mark.size(), sizeof header);
        bytes.remove_prefix(header_bytes);
        const auto [number, width, height] = header;
        const auto most = static_cast<std::int64_t>(bytes.size() / sizeof(float));
        if (width < 1 || height < 1 || width > most || height > most / width) {
            return failure("its size is not what it says");
        }
        const auto pixels = static_cast<std::size_t>(width * height);
        if (number == static_cast<std::int64_t>(channel)) {
            found = GreyPicture{width, height, std::vector<float>(pixels)};
            std::memcpy(found->values.data(), bytes.data(), pixels * sizeof(float));
        }
        bytes.remove_prefix(pixels * sizeof(float));
    } while (!bytes.empty());
    return found;
}

}  // namespace cascade
