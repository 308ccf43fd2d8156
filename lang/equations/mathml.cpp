// Converts TeX to MathML from left to right. A stack contains a row for each open brace, fraction
// and bracket, so formulas may be of any depth.
#include "lang/equations/mathml.h"

#include "lang/equations/equation_symbols.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace cascade {
namespace {

struct Sign {
    std::string_view command, text;
};
constexpr Sign signs_of_commands[] = {
    {"\\lor", "∨"},  {"\\land", "∧"},   {"\\lnot", "¬"},   {"\\le", "≤"},      {"\\ge", "≥"},
    {"\\ne", "≠"},   {"\\cdot", "·"},   {"\\times", "×"},  {"\\partial", "∂"}, {"\\sum", "∑"},
    {"\\prod", "∏"}, {"\\lfloor", "⌊"}, {"\\rfloor", "⌋"}, {"\\lceil", "⌈"},   {"\\rceil", "⌉"},
    {"\\dots", "…"}, {"\\nabla", "∇"},  {"\\langle", "⟨"}, {"\\rangle", "⟩"},
};

std::string element(std::string_view tag, std::string_view text) {
    return std::string("<").append(tag).append(">").append(text).append("</").append(tag).append(
        ">");
}

std::string escaped_markup(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '&') result += "&amp;";
        else result += c;
    }
    return result;
}

bool is_part_of_number(char c) {
    return c == '.' || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

class TexReader {
public:
    explicit TexReader(std::string_view tex) : tex_(tex) { open(Use::row); }

    std::string run() {
        while (at_ < tex_.size()) read();
        while (rows_.size() > 1) close();
        return joined(rows_.back().parts);
    }

private:
    enum class Use {
        row,
        numerator,
        denominator,
        root,
        cubic_root,
        superscript,
        subscript,
        fence,
        cases
    };
    struct Row {
        Use use = Use::row;
        std::vector<std::string> parts;
        /// The numerator, the opening bracket, or the cases that are complete.
        std::string before;
        std::string line = {};  ///< The cells of the present case that are complete.
    };

    void open(Use use, std::string before = {}) { rows_.push_back({use, {}, std::move(before)}); }
    void add(std::string part) { rows_.back().parts.push_back(std::move(part)); }
    static std::string joined(const std::vector<std::string>& parts) {
        std::string text;
        for (const std::string& part : parts) text += part;
        return text;
    }
    static std::string as_one(const std::vector<std::string>& parts) {
        return parts.size() == 1 ? parts.front() : element("mrow", joined(parts));
    }

    /// Completes the innermost row and appends it to the row around it.
    void close() {
        const Row row = std::move(rows_.back());
        rows_.pop_back();
        const std::string one = as_one(row.parts);
        switch (row.use) {
            case Use::row: return add(one);
            case Use::numerator: {
                skip("{");
                return open(Use::denominator, one);
            }
            case Use::denominator: return add(element("mfrac", row.before + one));
            case Use::root: return add(element("msqrt", one));
            case Use::cubic_root: return add(element("mroot", one + element("mn", "3")));
            case Use::fence: {
                std::vector<std::string> parts = row.parts;
                if (!row.before.empty()) parts.insert(parts.begin(), row.before);
                return add(as_one(parts));
            }
            case Use::cases:
                return add(element("mrow", element("mo", "{") + element("mtable", row.before)));
            case Use::superscript:
            case Use::subscript: break;
        }
        std::vector<std::string>& parts = rows_.back().parts;
        const std::string base = parts.empty() ? element("mrow", "") : std::move(parts.back());
        if (!parts.empty()) parts.pop_back();
        const bool is_under = base == element("mo", "∑") || base == element("mo", "∏");
        const bool is_above = row.use == Use::superscript;
        add(element(is_above ? "msup" : is_under ? "munder" : "msub", base + one));
    }
    /// Adds `part`. If the innermost row takes only one sign, completes the row.
    void add_and_close(std::string part) {
        add(std::move(part));
        if (is_single_) {
            is_single_ = false;
            close();
        }
    }

    bool skip(std::string_view text) {
        if (!tex_.substr(at_).starts_with(text)) return false;
        at_ += text.size();
        return true;
    }
    std::string_view command() {
        const std::size_t begin = at_++;
        while (at_ < tex_.size() && std::isalpha(static_cast<unsigned char>(tex_[at_]))) ++at_;
        if (at_ == begin + 1) ++at_;
        at_ = std::min(at_, tex_.size());
        return tex_.substr(begin, at_ - begin);
    }
    /// The plain text of a group, such as diff_u for {diff\_u}.
    std::string plain() {
        std::string text;
        skip("{");
        while (at_ < tex_.size() && tex_[at_] != '}') {
            if (tex_[at_] != '\\') {
                text += tex_[at_++];
                continue;
            }
            const std::string_view sign = command();
            text += sign == "\\textbackslash" ? std::string("\\") : std::string(sign.substr(1));
            skip("{}");
        }
        skip("}");
        return escaped_markup(text);
    }
    std::string bracket() {
        if (at_ < tex_.size() && tex_[at_] == '\\') return element("mo", sign_of(command()));
        const std::string text = escaped_markup(tex_.substr(at_++, 1));
        return text == "." ? "" : element("mo", text);
    }
    static std::string_view sign_of(std::string_view command) {
        for (const Sign& row : signs_of_commands) {
            if (row.command == command) return row.text;
        }
        return {};
    }

    void read() {
        const char c = tex_[at_];
        if (c == '\\') return read_command();
        if (is_part_of_number(c)) {
            const std::size_t begin = at_;
            while (at_ < tex_.size() && is_part_of_number(tex_[at_])) ++at_;
            return add_and_close(element("mn", tex_.substr(begin, at_ - begin)));
        }
        ++at_;
        if (c == ' ') return;
        if (c == '{') return is_single_ ? void(is_single_ = false) : open(Use::row);
        if (c == '}') {
            if (rows_.size() > 1) close();
            return;
        }
        if (c == '^' || c == '_') {
            open(c == '^' ? Use::superscript : Use::subscript);
            is_single_ = true;
            return;
        }
        if (c == '&') return end_cell();
        const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
        if (is_letter) return add_and_close(element("mi", std::string(1, c)));
        add_and_close(element("mo", c == '-' ? "−" : escaped_markup(std::string(1, c))));
    }

    void read_command() {
        const std::string_view word = command();
        if (word == "\\frac") {
            skip("{");
            return open(Use::numerator);
        }
        if (word == "\\sqrt") {
            const bool is_cubic = skip("[3]");
            skip("{");
            return open(is_cubic ? Use::cubic_root : Use::root);
        }
        if (word == "\\left") return open(Use::fence, bracket());
        if (word == "\\right") {
            const std::string end = bracket();
            if (!end.empty()) add(end);
            if (rows_.size() > 1) close();
            return;
        }
        if (word == "\\begin") {
            plain();
            return open(Use::cases);
        }
        if (word == "\\end") {
            plain();
            end_line();
            if (rows_.size() > 1) close();
            return;
        }
        if (word == "\\\\") return end_line();
        if (word == "\\,") return add("<mspace width=\"0.17em\"/>");
        if (word == "\\text" || word == "\\texttt") return add_and_close(element("mtext", plain()));
        if (word == "\\mathrm" || word == "\\operatorname" || word == "\\mathsf") {
            return add_and_close("<mi mathvariant=\"normal\">" + plain() + "</mi>");
        }
        if (word == "\\mathbf") {
            return add_and_close("<mi mathvariant=\"bold\">" + plain() + "</mi>");
        }
        if (word == "\\Bigl" || word == "\\Bigr" || word == "\\boldsymbol") return;
        if (const std::string_view sign = sign_of(word); !sign.empty()) {
            return add_and_close(element("mo", sign));
        }
        // Commands that are names: \alpha, \varphi; \ln, \max.
        std::string_view name = word.substr(1);
        if (name == "varepsilon" || name == "varphi") name.remove_prefix(3);
        add_and_close(element("mi", escaped_markup(Symbols().name(name))));
    }

    void end_cell() {
        Row& row = rows_.back();
        row.line += element("mtd", joined(row.parts));
        row.parts.clear();
    }
    void end_line() {
        end_cell();
        Row& row = rows_.back();
        row.before += element("mtr", std::exchange(row.line, {}));
    }

    std::string_view tex_;
    std::size_t at_ = 0;
    std::vector<Row> rows_;
    /// Whether the last row ends after one sign. A row that begins with a brace does not.
    bool is_single_ = false;
};

}  // namespace

std::string mathml_of(std::string_view tex) {
    return tex.size() > longest_mathml_source ? "" : TexReader(tex).run();
}

}  // namespace cascade
