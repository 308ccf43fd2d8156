// Writes the chunks of which PNG files consist. Animations have additional kinds of chunks.
#pragma once

#include "core/result.h"
#include "picture/image.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace cascade {

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// The largest number of bytes of image data in one chunk. Readers store a whole chunk in memory.
inline constexpr std::size_t longest_png_data = std::size_t{1} << 20;

void append_big_endian(std::string& bytes, std::size_t number);

/// Appends a chunk with its length and checksum.
void append_chunk(std::string& file, std::string_view name, std::string_view data);

/// Appends the chunk that declares colours as sRGB.
void append_srgb_chunk(std::string& file);

/// Fails if the texts are too long or contain a NUL.
Result<void> check_texts(const PngTexts& texts);

/// Appends a chunk for each text. Long texts are compressed with `level`, 1 to 12 (see deflated()).
void append_texts(std::string& file, const PngTexts& texts, int level);

}  // namespace cascade
