#include "picture/vti.h"

#include "core/check.h"
#include "core/file.h"
#include "picture/float_bytes.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <new>
#include <string_view>

namespace cascade {

namespace {

static_assert(std::endian::native == std::endian::little);

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

/// Bytes of an array's elements, which stand in front of them.
using BlockSize = std::uint64_t;

}  // namespace

std::string encode_vti(std::span<const VolumeArray> arrays, double spacing) {
    CHECK(!arrays.empty(), "a volume has an array");
    const PlaneLayout layout = arrays.front().field->layout();
    const auto bytes_of_array = static_cast<BlockSize>(layout.width * layout.row_count()) * 4;
    const std::string extent =
        fmt::format("0 {} 0 {} 0 {}", layout.width, layout.height, layout.depth);
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n"
        "  <ImageData WholeExtent=\"{0}\" Origin=\"0 0 0\" Spacing=\"{1} {1} {1}\">\n"
        "    <Piece Extent=\"{0}\">\n"
        "      <CellData Scalars=\"{2}\">\n",
        extent, spacing, escaped(arrays.front().name));
    BlockSize offset = 0;
    for (const VolumeArray& array : arrays) {
        text += fmt::format(
            "        <DataArray type=\"Float32\" Name=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            escaped(array.name), offset);
        offset += sizeof(BlockSize) + bytes_of_array;
    }
    text += "      </CellData>\n    </Piece>\n  </ImageData>\n"
            "  <AppendedData encoding=\"raw\">\n_";
    text.reserve(text.size() + offset + 64);
    for (const VolumeArray& array : arrays) {
        CHECK(array.field->layout() == layout, "the arrays of a volume have one layout");
        char size[sizeof(BlockSize)];
        std::memcpy(size, &bytes_of_array, sizeof size);
        text.append(size, sizeof size);
        append_floats(text, *array.field);
    }
    return text + "\n  </AppendedData>\n</VTKFile>\n";
}

Result<void> write_vti(const std::filesystem::path& path, std::span<const VolumeArray> arrays,
                       double spacing) {
    try {
        return write_file(path, encode_vti(arrays, spacing));
    } catch (const std::bad_alloc&) {
        return failure(fmt::format("cannot write '{}': there is not enough memory", path.string()));
    }
}

}  // namespace cascade
