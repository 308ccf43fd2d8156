#include "core/version.h"

namespace cascade {

std::string_view version() { return CASCADE_VERSION; }

}  // namespace cascade
