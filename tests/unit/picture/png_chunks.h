// Decodes and makes PNG files by the PNG specification, so that the tests are independent of
// libpng.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::test {

inline const std::string png_signature("\x89PNG\r\n\x1a\n", 8);

struct Chunk {
    std::string name;
    std::string data;
};

inline std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xffU);
    return bytes;
}

inline std::uint32_t number_at(std::string_view bytes, std::size_t begin) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        value = value << 8 | static_cast<unsigned char>(bytes[begin + k]);
    }
    return value;
}

inline std::uint32_t checksum(const std::string& bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

inline std::string assemble(const std::vector<Chunk>& chunks) {
    std::string file = png_signature;
    for (const Chunk& chunk : chunks) {
        const std::string body = chunk.name + chunk.data;
        file += big_endian(static_cast<std::uint32_t>(chunk.data.size())) + body;
        file += big_endian(checksum(body));
    }
    return file;
}

/// The chunks of a file, or nothing if it is not a sequence of complete chunks with right
/// checksums.
inline std::vector<Chunk> take_apart(std::string_view file) {
    if (!file.starts_with(png_signature)) return {};
    std::vector<Chunk> chunks;
    std::size_t place = png_signature.size();
    while (place < file.size()) {
        if (file.size() - place < 12) return {};
        const std::size_t size = number_at(file, place);
        if (file.size() - place - 12 < size) return {};
        const std::string body(file.substr(place + 4, size + 4));
        if (number_at(file, place + 8 + size) != checksum(body)) return {};
        chunks.push_back({body.substr(0, 4), body.substr(4)});
        place += size + 12;
    }
    return chunks;
}

inline std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string out(size, '\0');
    compress(reinterpret_cast<Bytef*>(out.data()), &size,
             reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
    out.resize(size);
    return out;
}

inline std::string inflated(const std::string& bytes, std::size_t size) {
    uLongf out_size = static_cast<uLongf>(size);
    std::string out(size, '\0');
    const int status =
        uncompress(reinterpret_cast<Bytef*>(out.data()), &out_size,
                   reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
    return status == Z_OK && out_size == size ? out : std::string();
}

/// One black grey pixel. Chunks can be put before and after its data.
inline std::vector<Chunk> tiny_png(const std::vector<Chunk>& before = {},
                                   const std::vector<Chunk>& after = {}) {
    std::vector<Chunk> chunks{
        {"IHDR", big_endian(1) + big_endian(1) + std::string("\x08\0\0\0\0", 5)}};
    chunks.insert(chunks.end(), before.begin(), before.end());
    chunks.push_back({"IDAT", deflated(std::string(2, '\0'))});
    chunks.insert(chunks.end(), after.begin(), after.end());
    chunks.push_back({"IEND", ""});
    return chunks;
}

/// The parts of a picture's file that tests check.
struct DecodedPng {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int depth = 0;
    /// 0 for grey, 2 for red, green and blue, and 4 more with alpha.
    int colour_type = 0;
    std::vector<unsigned> samples;  ///< Row by row, channel after channel.
};

inline unsigned paeth(int a, int b, int c) {
    const int p = a + b - c;
    const int pa = std::abs(p - a);
    const int pb = std::abs(p - b);
    const int pc = std::abs(p - c);
    if (pa <= pb && pa <= pc) return static_cast<unsigned>(a);
    return static_cast<unsigned>(pb <= pc ? b : c);
}

/// Undoes the row filters of section 9 of the PNG specification.
inline std::string unfiltered(const std::string& raw, std::size_t row_size,
                              std::size_t pixel_size) {
    std::string out;
    std::string above(row_size, '\0');
    for (std::size_t start = 0; start + row_size < raw.size(); start += row_size + 1) {
        std::string row(row_size, '\0');
        for (std::size_t k = 0; k < row_size; ++k) {
            const bool first = k < pixel_size;
            const int a = first ? 0 : static_cast<unsigned char>(row[k - pixel_size]);
            const int b = static_cast<unsigned char>(above[k]);
            const int c = first ? 0 : static_cast<unsigned char>(above[k - pixel_size]);
            unsigned prediction = 0;
            switch (raw[start]) {
                case 1: prediction = static_cast<unsigned>(a); break;
                case 2: prediction = static_cast<unsigned>(b); break;
                case 3: prediction = static_cast<unsigned>((a + b) / 2); break;
                case 4: prediction = paeth(a, b, c); break;
                default: break;
            }
            const unsigned value = static_cast<unsigned char>(raw[start + 1 + k]) + prediction;
            row[k] = static_cast<char>(value & 0xffU);
        }
        out += row;
        above = row;
    }
    return out;
}

inline DecodedPng decode(std::string_view file) {
    DecodedPng png;
    std::string data;
    for (const Chunk& chunk : take_apart(file)) {
        if (chunk.name == "IHDR") {
            png.width = number_at(chunk.data, 0);
            png.height = number_at(chunk.data, 4);
            png.depth = chunk.data[8];
            png.colour_type = chunk.data[9];
        }
        if (chunk.name == "IDAT") data += chunk.data;
    }
    const std::size_t sample_size = png.depth == 16 ? 2 : 1;
    const std::size_t channels =
        (png.colour_type % 4 == 2 ? 3u : 1u) + (png.colour_type >= 4 ? 1u : 0u);
    const std::size_t pixel_size = sample_size * channels;
    const std::size_t row_size = png.width * pixel_size;
    const std::string raw = inflated(data, (row_size + 1) * png.height);
    const std::string bytes = unfiltered(raw, row_size, pixel_size);
    for (std::size_t k = 0; k < bytes.size(); k += sample_size) {
        unsigned value = static_cast<unsigned char>(bytes[k]);
        if (sample_size == 2) value = value << 8 | static_cast<unsigned char>(bytes[k + 1]);
        png.samples.push_back(value);
    }
    return png;
}

}  // namespace cascade::test
