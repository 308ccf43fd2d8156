// Writes fields as .npy files.
#include "core/file.h"
#include "picture/npy.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <new>

namespace cascade {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t prefix_size = 10;  // \x93NUMPY, the version, the header's size.
constexpr std::size_t alignment = 64;    // NumPy starts the elements at a multiple of it.
constexpr std::uint32_t one_nan = 0x7fc00000;  // So that equal runs give equal files.

std::string header_of(const PlaneLayout& layout) {
    std::string text = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   layout.height, layout.width);
    const std::size_t used = prefix_size + text.size() + 1;
    text.append((alignment - used % alignment) % alignment, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(text.size() & 0xff);
    header += static_cast<char>(text.size() >> 8);
    return header + text;
}

}  // namespace

std::string encode_npy(const Field& field) {
    const PlaneLayout& layout = field.layout();
    std::string bytes = header_of(layout);
    bytes.reserve(bytes.size() + static_cast<std::size_t>(layout.width * layout.height) * 4);
    for (std::int64_t j = 0; j < layout.height; ++j) {
        const float* row = field.row(j);
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const float value = row[i];
            const auto bits = std::isnan(value) ? one_nan : std::bit_cast<std::uint32_t>(value);
            const auto element = std::bit_cast<std::array<char, 4>>(bits);
            bytes.append(element.data(), element.size());
        }
    }
    return bytes;
}

Result<void> write_npy(const std::filesystem::path& path, const Field& field) {
    try {
        return write_file(path, encode_npy(field));
    } catch (const std::bad_alloc&) {
        return failure(fmt::format("cannot write '{}': there is not enough memory", path.string()));
    }
}

}  // namespace cascade
