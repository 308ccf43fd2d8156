// The result of `cascade analyze` as JSON, for other programs.
#pragma once

#include "analysis/parameters.h"

#include <span>
#include <string>

namespace cascade {

/// Writes indented JSON with a line break at its end. Missing and infinite numbers are null. `map`
/// may be null.
std::string analysis_as_json(const analysis::StageAnalysis& analysis,
                             std::span<const analysis::ParameterScan> scans,
                             const analysis::ParameterMap* map);

}  // namespace cascade
