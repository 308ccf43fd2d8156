// Compresses data in the zlib format, which PNG files and pages use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace cascade {

/// Compresses bytes in the zlib format (RFC 1950). `level` is from 1 (fastest) to 12 (smallest
/// result). Throws std::bad_alloc.
std::string deflated(std::string_view bytes, int level);

/// The checksum that PNG files use for chunks.
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace cascade
