// Reads and writes the text chunks of PNG pictures. `cascade run picture.png` needs only these
// chunks to compute the picture again. Saved runs store the same data.
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

/// The script from a picture or a saved run, with everything needed to repeat the run.
struct EmbeddedScript {
    std::string name;
    std::string text;
    Overrides overrides;
    std::string picture_options;  ///< A PictureRequest as JSON.
    /// For a sheet of a sweep, the texts of its options --vary (see parse_variation()).
    std::vector<std::string> varied;
    std::string session;  ///< The log of a session. Empty for other pictures.
};

/// The key of the chunk that holds the log of a session.
inline constexpr const char* key_session = "Cascade session";

/// Returns the text chunks of a picture. Their keys are Software, Cascade name, Cascade script,
/// Cascade overrides, Cascade seed and Cascade picture.
PngTexts embed_script(const Script& script, const PictureRequest& picture);

/// Returns the text chunks for a sheet of a sweep. They include Cascade sweep, which contains the
/// texts of `varied`.
PngTexts embed_sweep(const Script& script, const PictureRequest& picture,
                     const std::vector<std::string>& varied);

/// Reads the text chunks from `bytes`, which are the content of `file`. Fails if the file is not a
/// PNG that Cascade wrote, with a message that names `file`.
Result<EmbeddedScript> parse_embedded_script(std::string_view bytes, const std::string& file);

/// Reads the text chunks of a file. Links, pipes and devices are refused.
Result<EmbeddedScript> read_embedded_script(const std::filesystem::path& path);

/// Returns `base`, in which the members that are set in `changes` are replaced. The parameters set
/// by `changes` are appended to the parameters of `base`, so that they are applied last.
Overrides merge(Overrides base, const Overrides& changes);

std::string overrides_to_json(const Overrides& overrides);
Result<Overrides> overrides_from_json(const std::string& json);

}  // namespace cascade
