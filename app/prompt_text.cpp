// Counts brackets and examines the last character, ignoring comments and strings. Does not parse.
#include "app/prompt_text.h"

#include "lang/service/known_names.h"
#include "lang/vocabulary/greek_letters.h"

#include <algorithm>
#include <array>

namespace cascade {

namespace {

bool ends_in_word(std::string_view text, std::string_view word) {
    if (!text.ends_with(word)) return false;
    return last_word(text.substr(0, text.size() - word.size())).empty();
}

bool ends_in_operator(std::string_view text) {
    constexpr std::array<std::string_view, 3> words = {"and", "or", "not"};
    if (text.empty()) return false;
    if (std::string_view("+-*/^,<>=").find(text.back()) != std::string_view::npos) return true;
    for (const std::string_view sign : {"−", "·", "⋅", "×", "≤", "≥", "≠"}) {
        if (text.ends_with(sign)) return true;
    }
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return ends_in_word(text, word); });
}

/// Returns the position at which the comment of a line begins, or the length of the line if the
/// line has no comment. A string that is not closed ends at the end of the line.
std::size_t comment_begin(std::string_view line) {
    bool quoted = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (line[k] == '"') quoted = !quoted;
        if (line[k] == '#' && !quoted) return k;
    }
    return line.size();
}

/// Returns the number of opening brackets in a line minus the number of closing brackets.
long open_brackets(std::string_view line) {
    long open = 0;
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == '(' || c == '[' || c == '{') ++open;
        if (c == ')' || c == ']' || c == '}') --open;
    }
    return open;
}

}  // namespace

std::string_view trim(std::string_view text) {
    constexpr std::string_view white = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(white);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(white) + 1 - begin);
}

bool is_complete(std::string_view text) {
    long open = 0;
    std::string_view last;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        line = trim(line.substr(0, comment_begin(line)));
        open += open_brackets(line);
        if (!line.empty()) last = line;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    // If there are too many closing brackets, the text counts as complete, so that the parser
    // reports them.
    return open <= 0 && !ends_in_operator(last);
}

bool says_nothing(std::string_view line) {
    return trim(line.substr(0, comment_begin(line))).empty();
}

Completion complete_word(std::string_view line, std::vector<std::string> names) {
    std::size_t begin = line.size() - last_word(line).size();
    if (begin == 1 && line[0] == ':') begin = 0;
    const std::string word = with_ascii_names(line.substr(begin));

    Completion completion;
    for (std::string& name : names) {
        if (name.starts_with(word)) completion.choices.push_back(std::move(name));
    }
    auto& choices = completion.choices;
    std::sort(choices.begin(), choices.end());
    choices.erase(std::unique(choices.begin(), choices.end()), choices.end());
    if (choices.empty()) return completion;

    // The choices are sorted, so a common beginning of the first and the last is common to all.
    const std::string& first = choices.front();
    const std::string& last = choices.back();
    std::size_t common = word.size();
    while (common < first.size() && common < last.size() && first[common] == last[common]) {
        ++common;
    }
    completion.insert = first.substr(word.size(), common - word.size());
    if (choices.size() == 1) completion.insert += ' ';
    return completion;
}

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    char quote = 0;
    bool is_open = false;
    for (const char c : text) {
        if (quote == 0 && (c == ' ' || c == '\t')) {
            is_open = false;
            continue;
        }
        if (!is_open) words.emplace_back();
        is_open = true;
        if (quote == 0 && (c == '"' || c == '\'')) quote = c;
        else if (c == quote) quote = 0;
        else words.back() += c;
    }
    return words;
}

}  // namespace cascade
