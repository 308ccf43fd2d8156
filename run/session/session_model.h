// Writes the pattern of a session as a model for other programs.
#pragma once

#include "run/script/picture_request.h"
#include "run/session/live_run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

enum class ModelForm {
    model,  ///< A GLB file with colours. For a plane, a rectangle with maps.
    maps,   ///< A ZIP file of a GLB file with maps, and of each map by itself.
};

struct SavedModel {
    std::string ending;  ///< ".glb" or "_maps.zip".
    std::string bytes;
    std::vector<std::string> notes;  ///< Information for readers of the file, a sentence each.
};

/// The present step as `cascade run -o NAME.glb` writes it, for maps with `--bake`. In maps a cell
/// is 4 texels wide, but maps have at most 2048 × 2048 texels. Files are created in a new folder
/// inside `folder`, which is removed afterwards. Fails with the errors of `request` and of the
/// writers.
Accepted<SavedModel> session_model(LiveRun& run, PictureRequest request, ModelForm form,
                                   const std::filesystem::path& folder);

}  // namespace cascade
