// What tests of the front end share: a text in, its messages out, as lines of text.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <string>
#include <vector>

namespace cascade {

/// `line:column message`, and ` | hint` where there is one.
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
