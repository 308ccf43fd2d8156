// Writes fields as .npy files.
#include "core/write_encoded.h"
#include "picture/float_bytes.h"
#include "picture/npy.h"

#include <fmt/format.h>

namespace cascade {
namespace {

// The bytes of \x93NUMPY, the version and the header's size.
constexpr std::size_t prefix_size = 10;
constexpr std::size_t alignment = 64;  // NumPy aligns the elements to this many bytes.

}  // namespace

std::string npy_head(std::string_view type, std::string_view shape, std::size_t spare) {
    std::string text =
        fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
    text.append(spare, ' ');
    const std::size_t used = prefix_size + text.size() + 1;
    text.append((alignment - used % alignment) % alignment, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(text.size() & 0xff);
    header += static_cast<char>(text.size() >> 8);
    return header + text;
}

std::string encode_npy(const Field& field) {
    const PlaneLayout& layout = field.layout();
    const std::string shape =
        layout.depth > 1 ? fmt::format("{}, {}, {}", layout.depth, layout.height, layout.width)
                         : fmt::format("{}, {}", layout.height, layout.width);
    std::string bytes = npy_head(fmt::format("<f{}", bytes_of(field.precision())), shape);
    bytes.reserve(bytes.size() + static_cast<std::size_t>(layout.width * layout.row_count()) *
                                     bytes_of(field.precision()));
    append_floats(bytes, field);
    return bytes;
}

Result<void> write_npy(const std::filesystem::path& path, const Field& field) {
    return write_encoded(path, [&] { return encode_npy(field); });
}

}  // namespace cascade
