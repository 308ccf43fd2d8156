// Finds the verb in a hint, and then the suggested text after the verb. Tries the suggestion:
// changes the script, checks it, and compares the messages before and after.
#include "lang/service/advice.h"

#include <algorithm>
#include <cstddef>
#include <set>

namespace cascade {
namespace {

/// The x in 'x' at the start of a text. Empty unless the closing quote is followed by a blank, by
/// one of ?,;: or by the end of the text.
std::string_view inside_quotes(std::string_view text) {
    if (!text.starts_with("'")) return {};
    for (std::size_t end = text.find('\'', 2); end < text.size(); end = text.find('\'', end + 1)) {
        const std::string_view after = text.substr(end + 1);
        if (after.empty() || std::string_view(" ?,;:").find(after[0]) != std::string_view::npos) {
            return text.substr(1, end - 1);
        }
    }
    return {};
}

std::multiset<std::string> messages_of(const Diagnostics& diagnostics, bool has_warnings) {
    std::multiset<std::string> messages;
    for (const Diagnostic& each : diagnostics.sorted()) {
        if (has_warnings || each.severity == Severity::error) messages.insert(each.message);
    }
    return messages;
}

}  // namespace

std::string_view text_to_write(std::string_view hint) {
    std::string_view bare;
    for (std::size_t at = 0; at < hint.size(); ++at) {
        for (const std::string_view verb : {"write ", "add ", "put ", "did you mean "}) {
            const std::string_view rest = hint.substr(at);
            if (!rest.starts_with(verb)) continue;
            const std::string_view after = rest.substr(verb.size());
            if (const auto quoted = inside_quotes(after); !quoted.empty()) return quoted;
            if (bare.empty() && (verb == "write " || verb == "add ")) bare = after;
        }
    }
    return bare;
}

std::optional<std::string> fix_of(const Diagnostic& diagnostic, const std::string& text,
                                  const Diagnostics& before,
                                  const std::function<Diagnostics(const std::string&)>& check) {
    const std::string fix(text_to_write(diagnostic.hint));
    if (fix.empty()) return std::nullopt;
    std::string changed = text;
    changed.replace(diagnostic.span.begin, diagnostic.span.end - diagnostic.span.begin, fix);
    // If the message is an error, warnings are not compared, because some warnings are given only
    // for scripts without errors.
    const bool is_warning = diagnostic.severity == Severity::warning;
    const auto old = messages_of(before, is_warning);
    const auto left = messages_of(check(changed), is_warning);
    const bool is_better = left.size() < old.size() && std::ranges::includes(old, left);
    return is_better ? std::optional(fix) : std::nullopt;
}

}  // namespace cascade
