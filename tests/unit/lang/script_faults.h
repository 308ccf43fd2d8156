// For tests of the front end: the messages about a text, as lines.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <string>
#include <vector>

namespace cascade {

/// `line:column message`, and ` | hint` if there is a hint.
inline std::vector<std::string> list_faults(const Diagnostics& diagnostics,
                                            const Sources& sources) {
    std::vector<std::string> faults;
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        const Location place = sources[diagnostic.span.source].locate(diagnostic.span.begin);
        std::string fault = std::to_string(place.line) + ":" + std::to_string(place.column) + " " +
                            diagnostic.message;
        if (!diagnostic.hint.empty()) fault += " | " + diagnostic.hint;
        faults.push_back(std::move(fault));
    }
    return faults;
}

}  // namespace cascade
