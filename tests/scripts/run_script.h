// Runs a script and holds it to what is expected of it.
#pragma once

#include "run/simulation/simulation.h"
#include "script_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cascade::test {

/// What takes the steps. `precision` is that of a script that does not say its own otherwise.
struct Configuration {
    std::string_view backend = "interp";
    Precision precision = Precision::single;
    int threads = 1;

    std::string name() const;  ///< "interpreter/single/3".
};

/// All configurations that this build has and a case asks for.
std::vector<Configuration> configurations_of(const ScriptCase& script);

/// What is not as expected, a sentence each. Files that the script reads are relative to `folder`.
std::vector<std::string> check_script(const ScriptFile& file, const ScriptCase& script,
                                      const std::filesystem::path& folder,
                                      const Configuration& configuration);

}  // namespace cascade::test
