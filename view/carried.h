// The contents of a page that includes its engine: a script, and the files that it needs.
#pragma once

#include "core/result.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <string>
#include <utility>
#include <vector>

namespace cascade {

/// The model's name among the carried files, which no script can use for a file.
inline constexpr const char* carried_model_name = "//model";

struct Carried {
    std::string name, text;
    bool is_exact = false;  ///< Steps flush denormal numbers wherever the program does.
    std::string overrides;  ///< As in pictures (run/script/embedded_script.h).
    /// By their names in the script: NumPy arrays as they are, pictures as their pixels
    /// (picture/pixel_file.h), and the model with its cells (run/domain/carried_model.h).
    std::vector<std::pair<std::string, std::string>> files;
};

/// Fails if a file cannot be read any more, and if a stage has a body, which pages cannot make.
Result<Carried> carried_by(const Script& script, const Simulation& simulation);

}  // namespace cascade
