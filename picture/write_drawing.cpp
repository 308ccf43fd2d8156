// Chooses the format of a drawing by the name of its file.
#include "core/write_encoded.h"
#include "picture/drawing.h"

#include <fmt/format.h>

namespace cascade {

Result<void> write_drawing(const std::filesystem::path& path, const Drawing& drawing) {
    const std::string ending = path.extension().string();
    return write_encoded(path, [&]() -> Result<std::string> {
        if (ending == ".svg") return as_svg(drawing);
        if (ending == ".pdf") return as_pdf(drawing);
        if (ending == ".png") return encode_png(as_image(drawing, 2), PngDepth::eight, {});
        return failure("a drawing cannot be written so", "end the name in .svg, .pdf or .png");
    });
}

}  // namespace cascade
