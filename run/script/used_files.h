// `use "file.cascade"`: the systems and functions of other files.
#pragma once

#include "run/script/script.h"

namespace cascade {

/// Reads the files that the script's tree uses, and those that these use, and adds their systems
/// and functions to the tree. Paths are relative to the file they are written in. A file that is
/// named again, in a cycle or not, is taken once. Texts that `script.overrides.used` has are taken
/// from there; it has all of them afterwards. Faults are diagnostics at the name of the file.
void load_used_files(Script& script);

}  // namespace cascade
