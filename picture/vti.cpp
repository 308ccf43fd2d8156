// Writes XML with the offsets of arrays, and then the arrays as raw bytes.
#include "picture/vti.h"

#include "core/check.h"
#include "core/write_encoded.h"
#include "picture/float_bytes.h"
#include "picture/xml_text.h"

#include <fmt/format.h>

#include <cstdint>

namespace cascade {

namespace {

/// The number of bytes of an array. It is stored before the array's elements.
using BlockSize = std::uint64_t;

/// The value of vtkDataSetAttributes::HIDDENCELL, which marks a hidden cell.
constexpr char hidden_cell = 32;

}  // namespace

std::string encode_vti(std::span<const VolumeArray> arrays, const std::array<double, 3>& spacing,
                       const Mask* inside) {
    CHECK(!arrays.empty(), "a volume has an array");
    const PlaneLayout layout = arrays.front().field->layout();
    const std::size_t bytes = bytes_of(arrays.front().field->precision());
    const auto cells = static_cast<BlockSize>(layout.width * layout.row_count());
    const BlockSize bytes_of_array = cells * bytes;
    const std::string extent =
        fmt::format("0 {} 0 {} 0 {}", layout.width, layout.height, layout.depth);
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n"
        "  <ImageData WholeExtent=\"{0}\" Origin=\"0 0 0\" Spacing=\"{1} {2} {3}\">\n"
        "    <Piece Extent=\"{0}\">\n"
        "      <CellData Scalars=\"{4}\">\n",
        extent, spacing[0], spacing[1], spacing[2], xml_escaped(arrays.front().name));
    BlockSize offset = 0;
    for (const VolumeArray& array : arrays) {
        text += fmt::format(
            "        <DataArray type=\"Float{}\" Name=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            8 * bytes, xml_escaped(array.name), offset);
        offset += sizeof(BlockSize) + bytes_of_array;
    }
    if (inside != nullptr) {
        text += fmt::format(
            "        <DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            offset);
        offset += sizeof(BlockSize) + cells;
    }
    text +=
        "      </CellData>\n    </Piece>\n  </ImageData>\n"
        "  <AppendedData encoding=\"raw\">\n_";
    text.reserve(text.size() + offset + 64);
    for (const VolumeArray& array : arrays) {
        CHECK(array.field->layout() == layout && bytes_of(array.field->precision()) == bytes,
              "the arrays of a volume have one layout and precision");
        append_number(text, bytes_of_array);
        append_floats(text, *array.field);
    }
    if (inside != nullptr) {
        append_number(text, cells);
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            for (std::int64_t i = 0; i < layout.width; ++i) {
                text += inside->row(row)[i] != 0 ? '\0' : hidden_cell;
            }
        }
    }
    return text + "\n  </AppendedData>\n</VTKFile>\n";
}

Result<void> write_vti(const std::filesystem::path& path, std::span<const VolumeArray> arrays,
                       const std::array<double, 3>& spacing, const Mask* inside) {
    return write_encoded(path, [&] { return encode_vti(arrays, spacing, inside); });
}

}  // namespace cascade
