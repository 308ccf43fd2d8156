// Compiled into both the program and the module, so that their versions can be compared.
#include "jit/code_version.h"

#include "jit/generator.h"

namespace cascade {

const char* code_version() { return CASCADE_CODE_VERSION; }

}  // namespace cascade
