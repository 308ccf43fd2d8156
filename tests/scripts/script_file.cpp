// Reads the comments that begin with '#:'.
#include "script_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string_view>

namespace cascade::test {

namespace {

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

/// The position of the only relation between blanks outside of brackets, or npos if there is none
/// or more than one.
std::size_t find_relation(const std::string& text, std::string& relation) {
    std::size_t found = std::string::npos;
    int depth = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '(' || text[k] == '[') ++depth;
        if (text[k] == ')' || text[k] == ']') --depth;
        if (depth > 0 || text[k] != ' ') continue;
        for (const char* each : {" = ", " < ", " > ", " <= ", " >= "}) {
            if (text.compare(k, std::string_view(each).size(), each) != 0) continue;
            if (found != std::string::npos) return std::string::npos;
            found = k;
            relation = trimmed(each);
        }
    }
    return found;
}

/// Reads one instruction after another and adds it to its case.
class Reader {
public:
    explicit Reader(const std::string& text);
    ScriptFile file;

private:
    void instruct(const std::string& words);
    void expect(const std::string& words);
    bool expect_message(const std::string& words);
    bool expect_value(const std::string& words);
    void error(const std::string& what) {
        file.errors.push_back(fmt::format("{}: {}", line_, what));
    }
    ScriptCase& current() { return file.cases.empty() ? shared_ : file.cases.back(); }

    ScriptCase shared_;          ///< The text and instructions before the first case.
    std::size_t line_ = 0;       ///< From 1.
    std::size_t code_line_ = 1;  ///< The last line with text other than comments.
};

Reader::Reader(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        ++line_;
        const std::size_t begin = line.find("#:");
        const std::string code = trimmed(line.substr(0, begin));
        if (!code.empty() && code[0] != '#') code_line_ = line_;
        if (begin != std::string::npos) instruct(trimmed(line.substr(begin + 2)));
        ScriptCase& owner = current();
        const auto lines_there = std::count(owner.text.begin(), owner.text.end(), '\n');
        owner.text.append(line_ - 1 - static_cast<std::size_t>(lines_there), '\n');
        owner.text += line + "\n";
    }
    if (file.cases.empty()) {
        file.cases.push_back(std::move(shared_));
    }
    for (const ScriptCase& each : file.cases) {
        if (each.expectations == 0) {
            file.errors.push_back(
                fmt::format("{}: nothing is expected", each.name.empty() ? "1" : each.name));
        }
        for (const std::string& other : each.same_as) {
            if (!file.find(other)) file.errors.push_back("there is no case '" + other + "'");
        }
        if (each.is_only_checked() &&
            (each.is_sound != each.messages.empty() || !each.values.empty() ||
             !each.same_as.empty() || !each.warnings.empty() || each.remarks || each.failure ||
             each.is_quiet)) {
            file.errors.push_back(
                fmt::format("{}: with errors, or 'expect sound', nothing runs, and nothing else "
                            "can be expected",
                            each.name));
        }
    }
}

void Reader::instruct(const std::string& words) {
    if (words.starts_with("case ")) {
        const std::string name = trimmed(words.substr(5));
        if (file.find(name)) error("there are two cases '" + name + "'");
        ScriptCase next = shared_;
        next.name = name;
        file.cases.push_back(std::move(next));
    } else if (words.starts_with("set ")) {
        current().sets.push_back(trimmed(words.substr(4)));
    } else if (words == "run once") {
        current().runs_once = true;
    } else if (words == "single only") {
        current().is_double = false;
    } else if (words == "double only") {
        current().is_single = false;
    } else if (words == "compiled only") {
        current().is_interpreted = false;
    } else if (words.starts_with("expect ")) {
        ++current().expectations;
        expect(trimmed(words.substr(7)));
    } else {
        error("'#: " + words + "' is no instruction");
    }
}

void Reader::expect(const std::string& words) {
    ScriptCase& owner = current();
    const auto rest = [&](std::string_view beginning) {
        return trimmed(std::string_view(words).substr(beginning.size()));
    };
    if (words == "sound") {
        owner.is_sound = true;
    } else if (words == "quiet") {
        owner.is_quiet = true;
    } else if (words == "no remark") {
        if (!owner.remarks) owner.remarks.emplace();
    } else if (words.starts_with("remark: ")) {
        if (!owner.remarks) owner.remarks.emplace();
        owner.remarks->push_back(rest("remark: "));
    } else if (words.starts_with("warning: ")) {
        owner.warnings.push_back(rest("warning: "));
    } else if (words.starts_with("failure: ")) {
        owner.failure = rest("failure: ");
    } else if (words.starts_with("same as ")) {
        owner.same_as.push_back(rest("same as "));
    } else if (!expect_message(words) && !expect_value(words)) {
        error("'expect " + words + "' is no expectation");
    }
}

bool Reader::expect_message(const std::string& words) {
    static const std::regex form(
        R"((error|warning|note)(?: (?:(<[^>]+>|[a-z_]+\.cascade):)?(?:(\d+):)?(\d+))?: (.+))");
    std::smatch parts;
    if (!std::regex_match(words, parts, form)) return false;
    Message message{parts[1], parts[2], 0, 0, parts[5]};
    if (parts[4].matched) {
        message.line = parts[3].matched ? std::stoul(parts[3]) : code_line_;
        message.column = std::stoul(parts[4]);
    } else if (message.kind == "error") {
        return false;
    }
    current().messages.push_back(std::move(message));
    return true;
}

bool Reader::expect_value(const std::string& words) {
    static const std::regex with_cell(R"((.+) at (\d+)(?:, (\d+))?(?:, (\d+))?)");
    ExpectedValue value;
    value.written = words;
    std::string rest = words;
    std::smatch parts;
    if (std::regex_match(words, parts, with_cell)) {
        value.cell.emplace();
        for (std::size_t k = 0; k < 3; ++k) {
            if (parts[k + 2].matched) (*value.cell)[k] = std::stoll(parts[k + 2]);
        }
        rest = parts[1];
    }
    if (const std::size_t tolerance = rest.rfind(" +- "); tolerance != std::string::npos) {
        char* end = nullptr;
        const std::string number = rest.substr(tolerance + 4);
        value.tolerance = std::strtod(number.c_str(), &end);
        if (*end != '\0' || !(*value.tolerance > 0)) return false;
        rest.resize(tolerance);
    }
    const std::size_t relation = find_relation(rest, value.relation);
    if (relation == std::string::npos) return false;
    value.left = trimmed(rest.substr(0, relation));
    value.right = trimmed(rest.substr(relation + value.relation.size() + 2));
    if (value.left.empty() || value.right.empty()) return false;
    if (value.tolerance && value.relation != "=") return false;
    current().values.push_back(std::move(value));
    return true;
}

}  // namespace

std::string print(const Message& message) {
    std::string place = message.source.empty() ? "" : message.source + ":";
    if (message.column > 0) place += fmt::format("{}:{}", message.line, message.column);
    return fmt::format("expect {}{}{}: {}", message.kind, place.empty() ? "" : " ", place,
                       message.text);
}

bool ScriptCase::is_only_checked() const {
    return is_sound || std::any_of(messages.begin(), messages.end(),
                                   [](const Message& each) { return each.kind == "error"; });
}

const ScriptCase* ScriptFile::find(const std::string& name) const {
    const auto found = std::find_if(cases.begin(), cases.end(),
                                    [&](const ScriptCase& each) { return each.name == name; });
    return found == cases.end() ? nullptr : &*found;
}

ScriptFile read_script_file(const std::string& text) { return Reader(text).file; }

bool matches(const std::string& text, const std::string& pattern) {
    static constexpr std::string_view anything = "…";
    std::vector<std::string> parts{""};
    for (std::size_t k = 0; k < pattern.size();) {
        if (pattern.compare(k, anything.size(), anything) == 0) {
            parts.emplace_back();
            k += anything.size();
        } else {
            parts.back() += pattern[k++];
        }
    }
    if (parts.size() == 1) return text == pattern;
    if (!text.starts_with(parts.front())) return false;
    std::size_t at = parts.front().size();
    for (std::size_t k = 1; k + 1 < parts.size(); ++k) {
        const std::size_t found = text.find(parts[k], at);
        if (found == std::string::npos) return false;
        at = found + parts[k].size();
    }
    return text.size() >= at + parts.back().size() && text.ends_with(parts.back());
}

}  // namespace cascade::test
