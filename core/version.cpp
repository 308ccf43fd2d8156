// A separate file, so that a new version recompiles only this one.
#include "core/version.h"

namespace cascade {

std::string_view version() { return CASCADE_VERSION; }

}  // namespace cascade
