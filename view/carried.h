// The contents of a page that includes its engine: a script and the files that it needs.
#pragma once

#include "core/result.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <string>
#include <utility>
#include <vector>

namespace cascade {

/// The name of the model among the carried files. No file of a script can have this name.
inline constexpr const char* carried_model_name = "//model";

struct Carried {
    std::string name, text;
    /// Whether steps set denormal numbers to 0 in exactly the same operations as the native
    /// program.
    bool is_exact = false;
    /// The overrides, in the format in which pictures contain them (run/script/embedded_script.h).
    std::string overrides;
    /// The contents of files, each with its name in the script: NumPy arrays unchanged, pictures as
    /// pixels (picture/pixel_file.h), and the model with its cells (run/domain/carried_model.h).
    std::vector<std::pair<std::string, std::string>> files;
};

/// Collects the contents of a page. Fails if a file can no longer be read, or if a stage has a
/// body, because pages cannot make bodies.
Result<Carried> carried_by(const Script& script, const Simulation& simulation);

}  // namespace cascade
