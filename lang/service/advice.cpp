// Finds the verb, then the text after it.
#include "lang/service/advice.h"

#include <cstddef>

namespace cascade {
namespace {

/// Of 'x' at the start of a text; empty if the quote does not end before a blank or a sign.
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

}  // namespace cascade
