// What a picture carries in its text chunks, so that `cascade run picture.png` draws it again; the
// same facts describe a saved run.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

/// A script found inside a picture or a saved run.
struct EmbeddedScript {
    std::string name;
    std::string text;
    Overrides overrides;
    std::string picture_options;      ///< JSON of a PictureRequest.
    std::vector<std::string> varied;  ///< Of a sweep's sheet: texts for parse_variation().
};

/// Chunks: Software, Cascade name, Cascade script, Cascade overrides, Cascade seed, Cascade
/// picture.
PngTexts embed_script(const Script& script, const PictureRequest& picture);

/// The same for a sheet of a sweep: Cascade sweep lists what was varied.
PngTexts embed_sweep(const Script& script, const PictureRequest& picture,
                     const std::vector<std::string>& varied);

/// Reads them back from the bytes of a file. Fails, naming it, if it is no PNG of Cascade's.
Result<EmbeddedScript> parse_embedded_script(std::string_view bytes, const std::string& file);

/// The same of a file itself: links, pipes and devices are refused.
Result<EmbeddedScript> read_embedded_script(const std::filesystem::path& path);

/// `base` with the members that `changes` has put over it; sets are appended, so that they win.
Overrides merge(Overrides base, const Overrides& changes);

std::string overrides_to_json(const Overrides& overrides);
Result<Overrides> overrides_from_json(const std::string& json);

}  // namespace cascade
