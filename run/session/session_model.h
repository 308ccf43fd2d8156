// Writes the pattern of a session as a model for other programs.
#pragma once

#include "run/script/picture_request.h"
#include "run/session/live_run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

enum class ModelForm {
    model,  ///< A GLB file with colours. For a plane, it is a rectangle with maps.
    maps,  ///< A ZIP file with a GLB file that contains maps, and with each map as a separate file.
};

struct SavedModel {
    std::string ending;  ///< The end of the file's name: ".glb" or "_maps.zip".
    std::string bytes;
    /// Information for users of the file. Each note is a sentence.
    std::vector<std::string> notes;
};

/// Writes the present step as `cascade run -o NAME.glb` does, or for maps as `cascade run` with
/// `--bake` does. In maps, a cell is 4 texels wide, but maps have at most 2048 × 2048 texels. Files
/// are created in a new folder inside `folder`, which is removed afterwards. Fails with the errors
/// of `request` and of the writers.
Accepted<SavedModel> session_model(LiveRun& run, PictureRequest request, ModelForm form,
                                   const std::filesystem::path& folder);

}  // namespace cascade
