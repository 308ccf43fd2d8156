// Which definitions of a system are vectors, as far as their texts say (internal to the printing of
// equations, which does not check the script).
#pragma once

#include "lang/check/system_statements.h"

#include <functional>
#include <set>
#include <string>

namespace cascade {

/// The names of definitions, and families of them, that are made of gradients and other vectors.
std::set<std::string, std::less<>> vector_names(const SystemStatements& system);

}  // namespace cascade
