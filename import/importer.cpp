// The table of formats that can be imported.
#include "import/importer.h"

#include <algorithm>
#include <array>

namespace cascade::importing {

namespace {

/// Accepts .vtu, too, so that the reader can refuse meshes with a suitable message.
bool is_ready(std::string_view file, std::string_view bytes) {
    return file.ends_with(".vti") || file.ends_with(".vtu") ||
           bytes.substr(0, 4096).find("<VTKFile") != std::string_view::npos;
}

bool is_visual_pde(std::string_view file, std::string_view bytes) {
    return file.starts_with("http") || file.ends_with(".json") ||
           (file.ends_with(".js") && bytes.find("presets[") != std::string_view::npos);
}

bool is_xpp(std::string_view file, std::string_view) { return file.ends_with(".ode"); }

bool is_sbml(std::string_view, std::string_view bytes) {
    return bytes.substr(0, 4096).find("<sbml") != std::string_view::npos;
}

}  // namespace

std::span<const ImportFormat> import_formats() {
    static constexpr std::array<ImportFormat, 4> all = {{
        {"pattern of Ready", ".vti", false, false, is_ready, read_ready},
        {"simulation of VisualPDE", "a link, .json or .js", false, true, is_visual_pde,
         read_visual_pde},
        {"model of XPPAUT", ".ode", true, false, is_xpp, read_xpp},
        {"model in SBML", ".xml, .sbml", true, false, is_sbml, read_sbml},
    }};
    return all;
}

const ImportFormat* format_of(std::string_view file, std::string_view bytes) {
    const auto all = import_formats();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ImportFormat& each) {
        return each.recognises(file, bytes);
    });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace cascade::importing
