// The standard form of a script.
#include "lang/format/format_script.h"
#include "lsp/answers.h"

#include <algorithm>

namespace cascade::lsp {
namespace {

/// The text with the line ends of `like`: "\r\n" if `like` has any, otherwise "\n".
std::string with_line_ends_of(const std::string& like, std::string text) {
    if (like.find("\r\n") == std::string::npos) return text;
    std::string result;
    for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return result;
}

}  // namespace

/// Makes one edit that replaces the lines from the first line that differs to the last one. Makes
/// no edit for a text that cannot be parsed, because its errors are shown already.
Result<Json> formatting(const Asked& asked) {
    const std::string& text = asked.document.text();
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("", text);
    auto result = format_script(source, sources, diagnostics);
    if (!result) return Json::array();
    result = with_line_ends_of(text, *std::move(result));
    if (*result == text) return Json::array();
    const auto [from, to] = std::ranges::mismatch(text, *result);
    std::size_t begin = static_cast<std::size_t>(from - text.begin());
    // If there is no line end, npos + 1 is 0.
    begin = begin == 0 ? 0 : text.rfind('\n', begin - 1) + 1;
    // The number of equal bytes at the ends of both texts, from the start of a line.
    std::size_t same = 0;
    const std::size_t most = std::min(text.size(), result->size()) - begin;
    for (std::size_t k = 1; k <= most && text[text.size() - k] == (*result)[result->size() - k];
         ++k) {
        const bool begins_line = k == text.size() || text[text.size() - k - 1] == '\n';
        const bool begins_there = k == result->size() || (*result)[result->size() - k - 1] == '\n';
        if (begins_line && begins_there) same = k;
    }
    return Json::array({{{"range", range_of(asked.document, begin, text.size() - same)},
                         {"newText", result->substr(begin, result->size() - same - begin)}}});
}

}  // namespace cascade::lsp
