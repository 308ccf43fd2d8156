// The chunks of PNG files, which animations extend by kinds of their own.
#pragma once

#include "core/result.h"
#include "picture/image.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace cascade {

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// The largest data of a chunk, in bytes, because readers buffer it.
inline constexpr std::size_t longest_png_data = std::size_t{1} << 20;

void append_big_endian(std::string& bytes, std::size_t number);

/// A chunk with its length and its checksum.
void append_chunk(std::string& file, std::string_view name, std::string_view data);

/// Says that colours are in sRGB.
void append_srgb_chunk(std::string& file);

/// Fails if the texts are too long or contain a NUL.
Result<void> check_texts(const PngTexts& texts);

/// A chunk for each text. Long ones are compressed with this effort, 1 to 12.
void append_texts(std::string& file, const PngTexts& texts, int level);

}  // namespace cascade
