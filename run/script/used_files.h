// `use "file.cascade"`: the systems and functions of other files.
#pragma once

#include "run/script/script.h"

namespace cascade {

/// Reads the files that the script's tree uses, directly or indirectly, and adds their systems and
/// functions to the tree. Paths are relative to the file they are written in. Each file is used
/// once, even if named again or in a cycle. Texts in `script.overrides.used` are not read again; it
/// holds all texts afterwards. Errors are reported at the name of the file.
void load_used_files(Script& script);

}  // namespace cascade
