// Replaces counted loops of C by their repeated statements, and gives the elements of arrays names.
#include "import/formula_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::importing {

namespace {

using Words = std::vector<FormulaWord>;

bool are_words(const Words& words, std::size_t at, std::initializer_list<std::string_view> wanted) {
    for (const std::string_view each : wanted) {
        if (at >= words.size() || (each != "*" && words[at].text != each)) return false;
        ++at;
    }
    return true;
}

/// The index after the bracket that closes the bracket before `at`. The number of words if no
/// bracket closes it.
std::size_t after_closing(const Words& words, std::size_t at, std::string_view open,
                          std::string_view close) {
    for (int depth = 1; at + 1 < words.size(); ++at) {
        if (words[at].text == open) ++depth;
        if (words[at].text == close && --depth == 0) return at + 1;
    }
    return words.size() - 1;
}

/// The words inside `for (int i = A; i < B; i++) { … }`, once for each turn of the loop. Empty if
/// the loop has another form or makes too many words.
std::optional<Words> written_out(const Words& words, std::size_t& at, std::size_t room) {
    const std::string variable = at + 3 < words.size() ? words[at + 3].text : "";
    const bool is_counted =
        are_words(words, at, {"for", "(", "int", "*", "=", "*", ";", variable, "<", "*", ";"}) &&
        (are_words(words, at + 11, {variable, "++", ")", "{"}) ||
         are_words(words, at + 11, {"++", variable, ")", "{"}));
    if (!is_counted || !words[at + 5].is_whole || !words[at + 9].is_whole) return std::nullopt;
    if (words[at + 5].text.size() > 4 || words[at + 9].text.size() > 4) return std::nullopt;
    const int first = std::stoi(words[at + 5].text), end = std::stoi(words[at + 9].text);
    const std::size_t begin = at + 15;
    at = after_closing(words, begin, "{", "}");
    Words body;
    for (int value = first; value < end; ++value) {
        for (std::size_t k = begin; k + 1 < at; ++k) {
            FormulaWord word = words[k];
            if (word.text == variable) {
                word.kind = FormulaWord::Kind::number;
                word.text = std::to_string(value);
                word.is_whole = true;
            }
            body.push_back(std::move(word));
        }
        if (body.size() > room) return std::nullopt;
    }
    return body;
}

}  // namespace

Words unroll_loops(Words words) {
    for (std::size_t at = 0; at < words.size(); ++at) {
        if (words[at].text != "for" || words[at].kind != FormulaWord::Kind::name) continue;
        std::size_t end = at;
        const std::size_t room = most_formula_words - std::min(most_formula_words, words.size());
        const auto body = written_out(words, end, room);
        if (!body) return words;
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(at),
                    words.begin() + static_cast<std::ptrdiff_t>(end));
        words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), body->begin(), body->end());
        --at;
    }
    Words named;
    for (std::size_t at = 0; at < words.size(); ++at) {
        named.push_back(words[at]);
        const bool is_element = words[at].kind == FormulaWord::Kind::name &&
                                are_words(words, at + 1, {"[", "*", "]"}) && words[at + 2].is_whole;
        if (!is_element) continue;
        named.back().text = fmt::format("{}_{}", words[at].text, words[at + 2].text);
        at += 3;
    }
    return named;
}

}  // namespace cascade::importing
