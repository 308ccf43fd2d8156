// Compression in the zlib format, which PNG files, pages and browsers share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace cascade {

/// The bytes in the zlib format (RFC 1950). `level` is 1, fast, to 12, small. Throws
/// std::bad_alloc.
std::string deflated(std::string_view bytes, int level);

/// The checksum of chunks of PNG files.
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace cascade
