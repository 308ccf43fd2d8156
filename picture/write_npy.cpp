// Writes fields as .npy files.
#include "core/file.h"
#include "picture/float_bytes.h"
#include "picture/npy.h"

#include <fmt/format.h>

#include <new>

namespace cascade {
namespace {

constexpr std::size_t prefix_size = 10;  // \x93NUMPY, the version, the header's size.
constexpr std::size_t alignment = 64;    // NumPy starts the elements at a multiple of it.

std::string header_of(const PlaneLayout& layout, Precision precision) {
    const std::string shape =
        layout.depth > 1 ? fmt::format("{}, {}, {}", layout.depth, layout.height, layout.width)
                         : fmt::format("{}, {}", layout.height, layout.width);
    std::string text =
        fmt::format("{{'descr': '<f{}', 'fortran_order': False, 'shape': ({}), }}",
                    bytes_of(precision), shape);
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
    std::string bytes = header_of(layout, field.precision());
    bytes.reserve(bytes.size() + static_cast<std::size_t>(layout.width * layout.row_count()) *
                                     bytes_of(field.precision()));
    append_floats(bytes, field);
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
