// Edit distance of names: optimal string alignment, the variant of the Damerau-Levenshtein distance
// that edits no substring twice (F. Damerau, "A technique for computer detection and correction of
// spelling errors", CACM 7(3), 1964).
#include "core/near_name.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cascade {

namespace {

constexpr std::size_t longest_name = 64;

char lower(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::size_t distance(std::string_view a, std::string_view b) {
    // The current row of the table and the two before it.
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0u : 1u)});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                                 lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last.swap(last);
        last.swap(row);
    }
    return last[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
    if (name.empty() || name.size() > longest_name) return {};
    const std::size_t allowed = std::max<std::size_t>(1, name.size() / 3);
    std::size_t smallest = allowed + 1;
    const std::string* nearest = nullptr;
    for (const std::string& candidate : candidates) {
        const std::size_t longer = std::max(name.size(), candidate.size());
        const std::size_t shorter = std::min(name.size(), candidate.size());
        if (longer - shorter > allowed) continue;
        const std::size_t edits = distance(name, candidate);
        // Names without a common letter are not near, however short they are.
        if (edits >= longer || edits >= smallest) continue;
        smallest = edits;
        nearest = &candidate;
    }
    return nearest ? *nearest : std::string();
}

}  // namespace cascade
