// A file of its own, so that a new version compiles this file alone.
#include "core/version.h"

namespace cascade {

std::string_view version() { return CASCADE_VERSION; }

}  // namespace cascade
