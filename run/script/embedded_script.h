// The text chunks of a picture, from which `cascade run picture.png` draws it again; the same data
// describe a saved run.
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

/// A script found in a picture or a saved run.
struct EmbeddedScript {
    std::string name;
    std::string text;
    Overrides overrides;
    std::string picture_options;      ///< JSON of a PictureRequest.
    std::vector<std::string> varied;  ///< Of a sweep's sheet: texts for parse_variation().
    std::string session;              ///< The log of a session; empty for other pictures.
};

/// The chunk of a picture that holds the log of a session.
inline constexpr const char* key_session = "Cascade session";

/// The chunks Software, Cascade name, Cascade script, Cascade overrides, Cascade seed, Cascade
/// picture.
PngTexts embed_script(const Script& script, const PictureRequest& picture);

/// The same for a sheet of a sweep: Cascade sweep lists what was varied.
PngTexts embed_sweep(const Script& script, const PictureRequest& picture,
                     const std::vector<std::string>& varied);

/// Reads them back from the bytes of a file. Fails, naming the file, if it is not a PNG of Cascade.
Result<EmbeddedScript> parse_embedded_script(std::string_view bytes, const std::string& file);

/// The same for a file; links, pipes and devices are refused.
Result<EmbeddedScript> read_embedded_script(const std::filesystem::path& path);

/// `base` with the members that `changes` overrides; sets are appended, so that they win.
Overrides merge(Overrides base, const Overrides& changes);

std::string overrides_to_json(const Overrides& overrides);
Result<Overrides> overrides_from_json(const std::string& json);

}  // namespace cascade
