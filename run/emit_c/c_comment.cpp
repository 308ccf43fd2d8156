// Inserts blanks between the characters of comment marks and trigraphs. Replaces backslashes and
// unprintable characters by question marks.
#include "run/emit_c/c_comment.h"

#include "core/utf8.h"

namespace cascade {

std::string c_comment(std::string_view text) {
    std::string result;
    for (std::size_t offset = 0; offset < text.size();) {
        const CodePoint point = decode_utf8(text, offset);
        const bool good = point.valid && point.value != '\\' && !is_unprintable(point.value);
        const std::string_view character = good ? text.substr(offset, point.size) : "?";
        const char before = result.empty() ? ' ' : result.back();
        const char now = character.front();
        if ((before == '*' && now == '/') || (before == '/' && now == '*') ||
            (before == '?' && now == '?')) {
            result += ' ';
        }
        result += character;
        offset += point.size;
    }
    return result;
}

}  // namespace cascade
