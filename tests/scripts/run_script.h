// Runs a script and compares it with its expectations.
#pragma once

#include "run/simulation/simulation.h"
#include "script_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cascade::test {

/// How steps are computed. `precision` applies if the script does not set its own.
struct Configuration {
    std::string_view backend = "interp";
    Precision precision = Precision::single;
    int threads = 1;

    std::string name() const;  ///< For example "interpreter/single/3".
};

/// All configurations of this build in which a case is to run.
std::vector<Configuration> configurations_of(const ScriptCase& script);

/// The differences from the expectations, one sentence for each. Files that the script reads are
/// relative to `folder`.
std::vector<std::string> check_script(const ScriptFile& file, const ScriptCase& script,
                                      const std::filesystem::path& folder,
                                      const Configuration& configuration);

}  // namespace cascade::test
