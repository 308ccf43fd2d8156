// Reads again the files that a simulation of the script has read.
#include "view/carried.h"

#include "core/granted_files.h"
#include "picture/npy.h"
#include "picture/pixel_file.h"
#include "run/domain/carried_model.h"
#include "run/domain/input_files.h"
#include "run/script/embedded_script.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

Result<Carried> carried_by(const Script& script, const Simulation& simulation) {
    for (const Stage& stage : script.program->stages) {
        if (stage.body.nodes.empty()) continue;
        return failure(fmt::format("a page that runs without the program cannot make the body of "
                                   "stage '{}'",
                                   stage.name),
                       "use 'cascade view'");
    }
    Carried carried{
        shown_name(script), script.text, false, overrides_to_json(script.overrides), {}};
    const GrantedFiles files(script.folder, script.overrides.reads);
    for (const auto& [name, channels] : input_files_of(script)) {
        auto bytes = files.read(name, std::max(largest_npy_file, largest_picture_file));
        if (!bytes) return tl::unexpected(bytes.error());
        if (bytes->starts_with("\x89PNG")) {
            std::string pixels;
            for (const PictureChannel channel : channels) {
                const auto picture = parse_grey_picture(*bytes, channel);
                if (!picture) return tl::unexpected(picture.error());
                pixels += print_pixel_file(*picture, channel);
            }
            bytes = std::move(pixels);
        }
        carried.files.emplace_back(name, *std::move(bytes));
    }
    if (const auto& model = simulation.domain().model) {
        carried.files.emplace_back(carried_model_name, print_carried_model(*model->cells));
    }
    return carried;
}

}  // namespace cascade
