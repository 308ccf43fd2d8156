// Reads and writes pictures without libpng and libdeflate. The page carries the pixels of pictures
// that a script reads (picture/pixel_file.h). PNG files are written without compression.
#include "picture/deflate.h"
#include "picture/grey_picture.h"
#include "picture/image.h"
#include "picture/pixel_file.h"

#include <algorithm>

namespace cascade {
namespace {

constexpr std::size_t longest_block = 65535;

void append_number(std::string& bytes, std::uint32_t number, int count) {
    for (int k = 0; k < count; ++k) bytes += static_cast<char>(number >> 8 * k);
}

/// The Adler-32 checksum of zlib (RFC 1950, section 8.2).
std::uint32_t adler32(std::string_view bytes) {
    std::uint32_t a = 1, b = 0;
    for (const char byte : bytes) {
        a = (a + static_cast<unsigned char>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

}  // namespace

Result<GreyPicture> parse_grey_picture(std::string_view bytes, PictureChannel channel) {
    return parse_pixel_file(bytes, channel);
}

Result<PngTexts> parse_png_texts(std::string_view) {
    return failure("a page that runs without the program cannot read pictures",
                   "use 'cascade view'");
}

/// Stores the bytes in uncompressed blocks (RFC 1951, section 3.2.4).
std::string deflated(std::string_view bytes, int) {
    std::string out = "\x78\x01";
    for (std::size_t begin = 0; begin == 0 || begin < bytes.size(); begin += longest_block) {
        const std::string_view block = bytes.substr(begin, longest_block);
        out += begin + block.size() == bytes.size() ? '\1' : '\0';
        append_number(out, static_cast<std::uint32_t>(block.size()), 2);
        append_number(out, static_cast<std::uint32_t>(~block.size()), 2);
        out += block;
    }
    const std::uint32_t sum = adler32(bytes);
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(sum >> shift);
    return out;
}

/// The CRC of PNG (W3C, "Portable Network Graphics (PNG) Specification (Second Edition)", annex D).
std::uint32_t crc32_of(std::string_view bytes) {
    std::uint32_t rest = ~std::uint32_t{0};
    for (const char byte : bytes) {
        rest ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ (rest & 1 ? 0xedb88320 : 0);
    }
    return ~rest;
}

}  // namespace cascade
