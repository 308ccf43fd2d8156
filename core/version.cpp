// In a file of its own, so that a new version recompiles only this file.
#include "core/version.h"

namespace cascade {

std::string_view version() { return CASCADE_VERSION; }

}  // namespace cascade
