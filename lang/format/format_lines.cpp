// Decides which words share a line. The author's line breaks stay, unless the style prescribes
// others.
#include "lang/format/format_lines.h"

#include "lang/format/format_script.h"
#include "lang/syntax/token_cursor.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr std::size_t block_indentation = 2;

class LineBuilder {
public:
    explicit LineBuilder(const std::vector<FormatWord>& words) : words_(words) {}

    std::vector<FormatLine> run() {
        for (std::size_t k = 0; k < words_.size(); ++k) {
            const FormatWord& word = words_[k];
            breaks_ = std::max(breaks_, word.breaks);
            if (word.kind == TokenKind::semicolon) {
                semicolon_ = k;
                continue;  // A `;` is written later, if another statement follows on the same line.
            }
            if (word.is_comment()) add_comment(k);
            else if (word.kind == TokenKind::open_curly) open_block(k);
            else if (word.kind == TokenKind::close_curly) close_block(k);
            else add_word(k);
            breaks_ = 0;
            semicolon_.reset();
        }
        return std::move(lines_);
    }

private:
    bool in_statement() const {
        if (before_ == nullptr) return false;
        return open_brackets_ > 0 || wants_operand(before_->kind);
    }
    std::size_t indentation() const { return in_block_ ? block_indentation : 0; }

    void begin_line(std::size_t indentation, bool goes_on, bool keep_blank_line) {
        FormatLine line;
        line.indentation = indentation;
        line.goes_on = goes_on;
        line.blank_line_before = keep_blank_line && breaks_ > 1 && !lines_.empty();
        lines_.push_back(std::move(line));
        width_ = indentation;
        line_before_ = nullptr;
    }
    void append(std::size_t k) {
        const FormatWord& word = words_[k];
        if (line_before_ != nullptr) width_ += blanks_between(*line_before_, word);
        width_ += width_of(word.text);
        lines_.back().cells.push_back({k, 0});
        line_before_ = before_ = &word;
        const bool opens =
            word.kind == TokenKind::open_round || word.kind == TokenKind::open_square;
        const bool closes =
            word.kind == TokenKind::close_round || word.kind == TokenKind::close_square;
        if (opens) ++open_brackets_;
        if (closes && open_brackets_ > 0) --open_brackets_;
    }

    void add_comment(std::size_t k) {
        const bool is_after = breaks_ == 0 && !lines_.empty() && !lines_.back().comment;
        if (!is_after) begin_line(indentation(), in_statement(), !in_statement() && !block_begins_);
        lines_.back().comment = k;
        block_begins_ = block_begins_ && is_after;
    }

    void add_word(std::size_t k) {
        const bool behind_comment = !lines_.empty() && lines_.back().comment.has_value();
        const bool splits = semicolon_ && splits_at_semicolons_ && !in_one_line_block_;
        const bool breaks = lines_.empty() || breaks_ > 0 || behind_comment;
        if (!needs_line_ && breaks && in_statement()) {
            begin_line(0, true, false);
        } else if (needs_line_ || splits || (breaks && !in_one_line_block_)) {
            open_brackets_ = 0;
            begin_line(indentation(), false, !block_begins_);
            if (!splits) splits_at_semicolons_ = !fits(k, indentation());
        } else if (semicolon_) {
            append(*semicolon_);
        }
        append(k);
        needs_line_ = false;
        block_begins_ = false;
    }

    void open_block(std::size_t k) {
        const bool behind_comment = !lines_.empty() && lines_.back().comment.has_value();
        if (lines_.empty() || behind_comment) begin_line(0, false, false);
        in_one_line_block_ = is_one_line_block(k);
        append(k);
        in_block_ = true;
        block_begins_ = true;
        needs_line_ = !in_one_line_block_;
    }

    void close_block(std::size_t k) {
        if (!in_one_line_block_) begin_line(0, false, false);
        append(k);
        in_block_ = in_one_line_block_ = block_begins_ = false;
        needs_line_ = true;
        open_brackets_ = 0;
    }

    /// Whether the author wrote the whole block on one line, and the formatted block fits on one
    /// line. Reads at most one line ahead.
    bool is_one_line_block(std::size_t open) const {
        std::size_t width = width_ + 2;
        for (std::size_t k = open + 1; k < words_.size(); ++k) {
            const FormatWord& word = words_[k];
            if (word.breaks > 0 || word.is_comment()) return false;
            width += blanks_between(words_[k - 1], word) + width_of(word.text);
            if (width > widest_script_line) return false;
            if (word.kind == TokenKind::close_curly) return true;
        }
        return false;
    }

    /// Whether the rest of the author's line fits on a line that already has `width` columns.
    bool fits(std::size_t first, std::size_t width) const {
        for (std::size_t k = first; k < words_.size(); ++k) {
            const FormatWord& word = words_[k];
            const bool ends = word.is_comment() || word.kind == TokenKind::open_curly ||
                              word.kind == TokenKind::close_curly;
            if (ends || (k > first && word.breaks > 0)) return true;
            if (k > first) width += blanks_between(words_[k - 1], word);
            width += width_of(word.text);
            if (width > widest_script_line) return false;
        }
        return true;
    }

    const std::vector<FormatWord>& words_;
    std::vector<FormatLine> lines_;
    const FormatWord* before_ = nullptr;  ///< The last word that is not a comment.
    /// The last word on this line that is not a comment.
    const FormatWord* line_before_ = nullptr;
    std::optional<std::size_t> semicolon_;  ///< The `;` after the last word, if there is one.
    std::size_t breaks_ = 0;                ///< The number of line breaks since the last word.
    std::size_t width_ = 0;                 ///< The width that the present line has at least.
    std::size_t open_brackets_ = 0;
    bool in_block_ = false;
    bool in_one_line_block_ = false;
    /// Whether nothing but the `{` of a block, and perhaps a comment after it, has been written so
    /// far.
    bool block_begins_ = false;
    bool needs_line_ = false;
    bool splits_at_semicolons_ = false;
};

}  // namespace

std::vector<FormatLine> format_lines(const std::vector<FormatWord>& words) {
    return LineBuilder(words).run();
}

}  // namespace cascade
