// Prints tokens for `--dump tokens`.
#include "core/utf8.h"
#include "lang/syntax/token.h"

#include <fmt/core.h>

#include <array>

namespace cascade {

namespace {

/// Whether a token of this kind is printed with its text.
bool has_own_text(TokenKind kind) {
    return kind == TokenKind::name || kind == TokenKind::number || kind == TokenKind::text ||
           kind == TokenKind::garbage;
}

/// A string on one line, in which unprintable bytes are escaped.
std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (std::size_t offset = 0; offset < text.size();) {
        const CodePoint point = decode_utf8(text, offset);
        if (point.valid && !is_unprintable(point.value)) {
            result += text.substr(offset, point.size);
        } else {
            for (std::uint32_t k = 0; k < point.size; ++k) {
                result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[offset + k]));
            }
        }
        offset += point.size;
    }
    return result + "\"";
}

}  // namespace

std::string_view spelling(TokenKind kind) {
    static constexpr std::string_view spellings[] = {
#define CASCADE_TOKEN(name, spelling) spelling,
        CASCADE_TOKENS(CASCADE_TOKEN)
#undef CASCADE_TOKEN
    };
    return spellings[static_cast<std::size_t>(kind)];
}

std::string print_tokens(const std::vector<Token>& tokens, const Sources& sources) {
    std::string result;
    // Columns are counted from the previous token, so that the time grows only linearly with the
    // length of a line.
    Location last{1, 1};
    std::uint32_t last_offset = 0;
    for (const Token& token : tokens) {
        const Source& source = sources[token.span.source];
        const std::string_view between =
            source.text().substr(last_offset, token.span.begin - last_offset);
        if (last_offset == 0 || between.find_first_of("\r\n") != std::string_view::npos) {
            last = source.locate(token.span.begin);
        } else {
            last.column += static_cast<std::uint32_t>(count_code_points(between));
        }
        last_offset = token.span.begin;
        result += fmt::format("{}:{} {}", last.line, last.column, spelling(token.kind));
        if (has_own_text(token.kind)) {
            std::string_view text = token.text;
            if (token.kind == TokenKind::text) text = text.substr(1, text.size() - 2);
            result += " " + quoted(text);
        }
        result += "\n";
    }
    return result;
}

}  // namespace cascade
