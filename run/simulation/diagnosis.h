// Lists of diagnoses. A row of a list says when its diagnosis applies, what is measured, and how
// the finding is described.
#pragma once

#include <span>
#include <string>

namespace cascade {

/// A way in which a result may be misleading.
template <typename Subject>
struct Diagnosis {
    bool (*applies)(const Subject& subject);
    std::string (*find)(const Subject& subject);  ///< Returns one sentence, or "".
};

/// Makes a row of a list. `measure` returns a finding or nothing. `words` describes the finding, or
/// returns "" if the finding turns out to be harmless.
template <typename Subject, bool (*applies)(const Subject&), auto measure, auto words>
constexpr Diagnosis<Subject> diagnosis() {
    return {applies, [](const Subject& subject) {
                const auto found = measure(subject);
                return found ? words(subject, *found) : std::string();
            }};
}

/// Returns the description of the first diagnosis that finds something, or "" if none does.
template <typename Subject>
std::string first_of(std::span<const Diagnosis<Subject>> list, const Subject& subject) {
    for (const Diagnosis<Subject>& each : list) {
        if (!each.applies(subject)) continue;
        if (std::string words = each.find(subject); !words.empty()) return words;
    }
    return {};
}

}  // namespace cascade
