// Writes the parts of an imported script as text.
#include "import/draft.h"

#include "core/check.h"
#include "lang/format/format_script.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cascade::importing {

namespace {

/// Adds a comment, divided into lines of at most 98 letters.
void add_comment(std::string& text, const std::string& comment) {
    constexpr std::size_t widest = 98;
    std::string line;
    std::size_t begin = 0;
    while (begin < comment.size()) {
        const std::size_t end = std::min(comment.find(' ', begin), comment.size());
        const std::string word = comment.substr(begin, end - begin);
        begin = end + 1;
        if (!line.empty() && line.size() + 1 + word.size() > widest) {
            text += "# " + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    if (!line.empty()) text += "# " + line + "\n";
}

void add_statements(std::string& text, const std::vector<std::string>& statements) {
    if (!statements.empty() && !text.ends_with("{\n")) text += "\n";
    for (const std::string& each : statements) text += "  " + each + "\n";
}

std::string block(const std::string& head, const std::vector<std::string>& statements) {
    std::string line = head + " { ";
    for (const std::string& each : statements) {
        line += each + (&each == &statements.back() ? "" : "; ");
    }
    line += " }\n";
    if (line.size() <= widest_script_line) return line;
    std::string text = head + " {\n";
    for (const std::string& each : statements) text += "  " + each + "\n";
    return text + "}\n";
}

bool is_taken(const std::string& name) {
    return reserved(name) != Reserved::no ||
           std::find(std::begin(keywords), std::end(keywords), name) != std::end(keywords);
}

}  // namespace

std::string write_script(const Draft& draft) {
    std::string text;
    for (const std::string& each : draft.about) add_comment(text, each);
    for (const std::string& each : draft.remarks) add_comment(text, "Note: " + each);
    text += "\n";
    for (const std::string& each : draft.functions) text += each + "\n";
    if (!draft.functions.empty()) text += "\n";
    text += "system imported {\n";
    for (const auto* part :
         {&draft.parameters, &draft.starts, &draft.definitions, &draft.rates, &draft.sides}) {
        add_statements(text, *part);
    }
    text += "}\n\n" + block("domain", draft.domain) + "\n";
    std::vector<std::string> stage = draft.stage;
    if (draft.speed > 0) stage.insert(stage.begin(), "speed: " + number_text(draft.speed));
    text += block("stage grow: imported", stage);
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("imported", text);
    // A text that cannot be formatted is returned unchanged. Its errors are reported when the
    // script is checked.
    return format_script(source, sources, diagnostics).value_or(text);
}

bool has_word(std::string_view statement, std::string_view name) {
    const auto is_part = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    for (std::size_t at = statement.find(name); at != std::string_view::npos;
         at = statement.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        const bool begins = at == 0 || !is_part(statement[at - 1]);
        if (begins && (end == statement.size() || !is_part(statement[end]))) return true;
    }
    return false;
}

std::string plain_line(std::string_view text) {
    std::string line;
    for (const char letter : text) {
        const bool is_blank = static_cast<unsigned char>(letter) <= ' ' || letter == '\x7f';
        if (!is_blank) {
            line += letter;
        } else if (!line.empty() && line.back() != ' ') {
            line += ' ';
        }
    }
    while (line.ends_with(' ')) line.pop_back();
    return line;
}

std::string FreeNames::declare(std::string_view foreign) {
    std::string name(foreign);
    while (is_taken(name) || used_.contains(name)) name += '_';
    used_.insert(name);
    return name;
}

std::string FreeNames::fresh(std::string_view wanted) {
    std::string name(wanted);
    for (int number = 2; is_taken(name) || used_.contains(name); ++number) {
        name = fmt::format("{}{}", wanted, number);
    }
    used_.insert(name);
    return name;
}

}  // namespace cascade::importing
