// The header of a PLY file: the elements that follow, their properties and the number formats (G.
// Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include "core/result.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

enum class PlyNumber : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// The number of bytes that a number takes in a binary file.
std::size_t size_of(PlyNumber type);

struct PlyProperty {
    std::string name;
    PlyNumber type = PlyNumber::float32;
    bool is_list = false;
    PlyNumber count_type = PlyNumber::uint8;  ///< The type of a list's length.
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// The fewest bytes that one element takes in the file.
    std::size_t least_bytes(bool is_text) const;
};

struct PlyHeader {
    enum class Format : std::uint8_t { text, little_endian, big_endian };
    Format format = Format::text;
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< The size of the header in bytes.
};

/// Fails, with the line, on malformed headers, and if the file is too short for its elements.
Result<PlyHeader> read_ply_header(std::string_view bytes);

}  // namespace cascade
