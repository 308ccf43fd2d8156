// Reads the statements of a file of XPPAUT. B. Ermentrout, "Simulating, Analyzing, and Animating
// Dynamical Systems", SIAM 2002, describes the format.
#include "import/xpp.h"

#include "import/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cascade::importing {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

class XppReader {
public:
    explicit XppReader(Import& import) : import_(import) {}

    std::optional<XppFile> read() {
        const std::string_view text = import_.bytes();
        for (std::size_t begin = 0; begin < text.size() && !failed_ && !is_done_;) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            line({import_.source, static_cast<std::uint32_t>(begin),
                  static_cast<std::uint32_t>(end)});
            begin = end + 1;
        }
        if (failed_) return std::nullopt;
        return std::move(file_);
    }

private:
    std::string_view text(Span span) const { return import_.sources.text(span); }

    bool fail(Span span, std::string why, std::string hint = "") {
        if (!failed_) import_.diagnostics.error(span, std::move(why), std::move(hint));
        failed_ = true;
        return false;
    }

    Span trimmed(Span span) const {
        while (span.begin < span.end && is_space(text(span).front())) ++span.begin;
        while (span.begin < span.end && is_space(text(span).back())) --span.end;
        return span;
    }
    Span part(Span span, std::size_t begin, std::size_t end) const {
        return trimmed({span.source, span.begin + static_cast<std::uint32_t>(begin),
                        span.begin + static_cast<std::uint32_t>(end)});
    }

    static std::string lower(std::string_view words) {
        std::string made;
        for (const char c : words) {
            if (!is_space(c))
                made += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
        return made;
    }

    void line(Span span) {
        span = trimmed(span);
        const std::string_view words = text(span);
        if (words.empty() || words.front() == '#' || words.front() == '"') return;
        if (words.back() == '\\') {
            fail(span, "lines that continue after '\\' cannot be read", "join the lines");
            return;
        }
        if (words.front() == '@') return options(part(span, 1, words.size()));
        if (words.front() == '!') return equation(part(span, 1, words.size()));
        const std::size_t blank = std::min(words.find_first_of(" \t"), words.size());
        const std::string first = lower(words.substr(0, blank));
        const Span rest = part(span, blank, words.size());
        if (first == "done" || first == "d") {
            is_done_ = true;
        } else if (first == "par" || first == "param" || first == "p" || first == "parameter" ||
                   first == "num" || first == "number") {
            pairs(rest, file_.parameters);
        } else if (first == "init" || first == "i") {
            pairs(rest, file_.starts);
        } else if (first == "aux" || first == "set" || first == "only" || first == "o") {
            return;  // Such statements only choose what XPPAUT shows.
        } else if (first == "wiener" || first == "table" || first == "global" ||
                   first == "markov" || first == "bdry" || first == "b" || first == "solv" ||
                   first == "special" || first == "option" || first == "export" ||
                   first == "volt") {
            fail(span, fmt::format("'{}' has no counterpart in Cascade", first));
        } else if (words.front() == '%') {
            fail(span, "groups of lines between '%' cannot be read",
                 "write an array in each line: u[1..50]' = …");
        } else {
            equation(span);
        }
    }

    /// Reads lists such as "a=1, b=2" and "a=1 b=2".
    void pairs(Span span, std::vector<XppPair>& all) {
        std::string_view words = text(span);
        std::size_t at = 0;
        while (at < words.size() && !failed_) {
            const std::size_t sign = words.find('=', at);
            if (sign == std::string_view::npos) {
                fail(part(span, at, words.size()), "'name=value' is expected here");
                return;
            }
            std::size_t begin = sign + 1;
            while (begin < words.size() && is_space(words[begin])) ++begin;
            std::size_t end = begin;
            while (end < words.size() && !is_space(words[end]) && words[end] != ',') ++end;
            XppPair made;
            made.place = part(span, at, sign);
            made.value = part(span, begin, end);
            made.name = lower(text(made.place));
            if (!array(made)) return;
            all.push_back(std::move(made));
            at = end;
            while (at < words.size() && (is_space(words[at]) || words[at] == ',')) ++at;
        }
    }

    void options(Span span) {
        std::vector<XppPair> all;
        pairs(span, all);
        for (const XppPair& each : all) file_.options[each.name] = lower(text(each.value));
    }

    /// Removes "[1..50]" from a name, which then means all elements of the array.
    bool array(XppPair& pair) {
        const std::size_t open = pair.name.find('[');
        if (open == std::string::npos) return true;
        const std::size_t close = pair.name.find(']', open);
        const std::size_t dots = pair.name.find("..", open);
        if (close == std::string::npos || dots == std::string::npos || dots > close) {
            return fail(pair.place, "an array such as u[1..50] is expected here");
        }
        const auto first = plain_number(pair.name.substr(open + 1, dots - open - 1));
        const auto last = plain_number(pair.name.substr(dots + 2, close - dots - 2));
        if (!first || !last || *first < 0 || *last > 1e6 || *last < *first + 3) {
            return fail(pair.place,
                        "the indices of an array must be whole numbers from 0 to 1,000,000, "
                        "and there must be at least four of them");
        }
        const auto from = static_cast<long>(*first), to = static_cast<long>(*last);
        if (file_.has_arrays && (from != file_.first || to != file_.last)) {
            return fail(pair.place,
                        fmt::format("all arrays must go from {} to {}", file_.first, file_.last));
        }
        file_.has_arrays = true;
        file_.first = from;
        file_.last = to;
        pair.name.erase(open, close - open + 1);
        pair.is_member = true;
        return true;
    }

    void equation(Span span) {
        const std::string_view words = text(span);
        const std::size_t sign = words.find('=');
        if (sign == std::string_view::npos) {
            fail(span, "this statement is unknown");
            return;
        }
        XppPair made;
        made.place = part(span, 0, sign);
        made.value = part(span, sign + 1, words.size());
        made.name = lower(text(made.place));
        std::string& name = made.name;
        const bool is_fraction = name.starts_with("d") && name.ends_with("/dt") && name.size() > 4;
        if (is_fraction) name = name.substr(1, name.size() - 4) + "'";
        if (name.ends_with("(t+1)")) {
            fail(span, "maps from step to step have no counterpart in Cascade");
            return;
        }
        const bool is_start = name.ends_with("(0)");
        if (is_start) name.erase(name.size() - 3);
        const bool is_rate = name.ends_with('\'');
        if (is_rate) name.pop_back();
        if (!array(made)) return;
        if (is_start) {
            file_.starts.push_back(std::move(made));
        } else if (is_rate) {
            file_.rates.push_back(std::move(made));
        } else if (name.find('(') != std::string::npos) {
            file_.functions.push_back(std::move(made));
        } else {
            file_.definitions.push_back(std::move(made));
        }
    }

    Import& import_;
    XppFile file_;
    bool failed_ = false;
    bool is_done_ = false;
};

}  // namespace

std::optional<XppFile> read_xpp_statements(Import& import) { return XppReader(import).read(); }

}  // namespace cascade::importing
