// Replaces bars in one pass from left to right, with a stack of open brackets and bars.
#include "lang/syntax/bars.h"

#include "lang/syntax/paper_notation.h"
#include "lang/syntax/token_cursor.h"

#include <fmt/core.h>

namespace cascade {

namespace {

class BarReader {
public:
    BarReader(const std::vector<Token>& in, Diagnostics& diagnostics)
        : in_(in), diagnostics_(diagnostics) {}

    std::vector<Token> run() {
        out_.reserve(in_.size() + in_.size() / 8);
        while (at_ < in_.size()) read();
        return std::move(out_);
    }

private:
    void read() {
        const Token& here = in_[at_];
        switch (here.kind) {
            case TokenKind::bar: return read_bar();
            case TokenKind::open_round:
            case TokenKind::open_square: open_.push_back(here); break;
            case TokenKind::close_round:
            case TokenKind::close_square:
                report_open_bars();
                if (!open_.empty()) open_.pop_back();
                break;
            case TokenKind::newline:
                if (open_.empty() || open_.front().kind != TokenKind::bar) break;
                if (at_ == 0 || !wants_operand(in_[at_ - 1].kind)) report_open_bars();
                break;
            case TokenKind::comma:
            case TokenKind::dots:
            case TokenKind::colon: report_open_bars(); break;
            case TokenKind::semicolon:
            case TokenKind::open_curly:
            case TokenKind::close_curly:
            case TokenKind::end_of_text:
                report_open_bars();
                open_.clear();
                break;
            default: break;
        }
        out_.push_back(in_[at_++]);
    }

    void read_bar() {
        const Token& here = in_[at_];
        const bool is_open = !open_.empty() && open_.back().kind == TokenKind::bar;
        if (!is_after_operand(is_open)) return open();
        if (is_open) {
            open_.pop_back();
            out_.push_back({TokenKind::close_round, here.span, ")"});
            ++at_;
            return;
        }
        const bool is_double = is_bar(at_ + 1) && touches(at_ + 1);
        if (!is_double && touches(at_ + 1) && closes_on_line(at_ + 1)) return open();
        const Span whole = is_double ? join(here.span, in_[at_ + 1].span) : here.span;
        diagnostics_.error(
            whole, fmt::format("'{}' is not an operator of the language", is_double ? "||" : "|"),
            "write 'or'");
        out_.push_back({TokenKind::keyword_or, whole, "or"});
        at_ += is_double ? 2 : 1;
    }
    void open() {
        const Token& bar = in_[at_++];
        open_.push_back(bar);
        out_.push_back({TokenKind::name, bar.span, "abs"});
        out_.push_back({TokenKind::open_round, {bar.span.source, bar.span.end, bar.span.end}, "("});
    }

    bool is_bar(std::size_t at) const { return at < in_.size() && in_[at].kind == TokenKind::bar; }
    bool touches(std::size_t at) const {
        return at < in_.size() && in_[at - 1].span.end == in_[at].span.begin;
    }
    bool closes_on_line(std::size_t at) const {
        for (; at < in_.size() && in_[at].kind != TokenKind::newline; ++at) {
            if (is_bar(at)) return true;
        }
        return false;
    }
    /// Whether the token follows an operand. The words `over` and `in` usually come between
    /// operands. Within bars these two words can only be names.
    bool is_after_operand(bool is_open) const {
        if (at_ == 0) return false;
        const Token& before = in_[at_ - 1];
        switch (before.kind) {
            case TokenKind::name: return is_open || !is_word_between_operands(before.text);
            case TokenKind::number:
            case TokenKind::text:
            case TokenKind::garbage:
            case TokenKind::prime:
            case TokenKind::superscript:
            case TokenKind::close_round:
            case TokenKind::close_square: return true;
            case TokenKind::bar: return out_.back().kind == TokenKind::close_round;
            default: return false;
        }
    }
    /// Reports the bars that are open inside the innermost bracket, and closes them.
    void report_open_bars() {
        bool is_reported = false;
        while (!open_.empty() && open_.back().kind == TokenKind::bar) {
            const Span end{in_[at_].span.source, in_[at_].span.begin, in_[at_].span.begin};
            if (!is_reported) {
                diagnostics_.error(open_.back().span, "this '|' is never closed",
                                   "write '|' at both ends of what it holds, or abs(…)");
                out_.push_back({TokenKind::garbage, end, {}});
            }
            is_reported = true;
            out_.push_back({TokenKind::close_round, end, ")"});
            open_.pop_back();
        }
    }

    const std::vector<Token>& in_;
    Diagnostics& diagnostics_;
    std::vector<Token> out_;
    std::vector<Token> open_;  ///< Open brackets and bars.
    std::size_t at_ = 0;
};

}  // namespace

std::vector<Token> without_bars(const std::vector<Token>& tokens, Diagnostics& diagnostics) {
    return BarReader(tokens, diagnostics).run();
}

}  // namespace cascade
