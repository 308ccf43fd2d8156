// What a page carries that has its engine with it: a script, and the files that it needs.
#pragma once

#include "core/result.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <string>
#include <utility>
#include <vector>

namespace cascade {

/// The name of the model among the files that are carried: that of no file a script can name.
inline constexpr const char* carried_model_name = "//model";

struct Carried {
    std::string name, text;
    bool is_exact = false;  ///< Steps flush denormal numbers wherever the program does.
    std::string overrides;  ///< As pictures carry them (run/script/embedded_script.h).
    /// By the names that the script has for them: NumPy arrays as they are, pictures as their
    /// pixels (picture/pixel_file.h), and the model with its cells (run/domain/carried_model.h).
    std::vector<std::pair<std::string, std::string>> files;
};

/// Fails if a file cannot be read any more, and if a stage has a body, which pages cannot make.
Result<Carried> carried_by(const Script& script, const Simulation& simulation);

}  // namespace cascade
