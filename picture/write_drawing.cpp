// Chooses the format of a drawing by the name of its file.
#include "core/file_format.h"
#include "core/write_encoded.h"
#include "picture/drawing.h"

#include <fmt/format.h>

#include <array>

namespace cascade {

namespace {

struct DrawingRow {
    FileFormat format;
    Result<std::string> (*encode)(const Drawing& drawing);
};

Result<std::string> as_png(const Drawing& drawing) {
    return encode_png(as_image(drawing, 2), PngDepth::eight, {});
}

constexpr std::array drawing_writers = {
    DrawingRow{FileFormat::svg, as_svg},
    DrawingRow{FileFormat::pdf, as_pdf},
    DrawingRow{FileFormat::png, as_png},
};
static_assert(has_all_of(drawing_writers, FormatKind::figure));

}  // namespace

Result<void> write_drawing(const std::filesystem::path& path, const Drawing& drawing) {
    const FormatRow* const format = find_format(path);
    const DrawingRow* const writer = format ? row_of(drawing_writers, format->format) : nullptr;
    return write_encoded(path, [&]() -> Result<std::string> {
        if (writer) return writer->encode(drawing);
        return failure("a drawing cannot be written with this ending",
                       "end the name in " + endings_of(FormatTrait::drawing, "or"));
    });
}

}  // namespace cascade
