// Only this file contains the version, so that a new version recompiles nothing else.
#include "core/version.h"

namespace cascade {

std::string_view version() { return CASCADE_VERSION; }

}  // namespace cascade
