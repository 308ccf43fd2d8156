// Sets the columns of words. Columns that an author has aligned (`=` and `+` of neighbouring
// equations, comments after statements) stay aligned. All other extra blanks are removed.
//
// If the words before an aligned column need more room, the column is moved to the right. Otherwise
// the distance between the column and the words before it stays as the author wrote it. So
// formatting the result again changes nothing.
#include "lang/format/format_lines.h"

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

constexpr std::size_t before_comment = 2;  // The least number of blanks before a comment.
// The indentation of a line that continues a statement, unless a column aligns the line.
constexpr std::size_t goes_on_by = 4;
// The largest indentation, so that lines stay visible if brackets are deeply nested.
constexpr std::size_t furthest_start = 60;
constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

enum class Alignment { free, relation, sum };

/// Words of neighbouring lines that are in the same column.
struct Column {
    struct Member {
        std::size_t line, cell;
    };
    std::vector<Member> members;
    std::size_t source_column = 0;
    bool was_stretched = false;  ///< Whether any of the words has more than one blank before it.
};

/// Finds the position of a column from the words directly before it.
class Place {
public:
    explicit Place(bool respelled) : respelled_(respelled) {}

    /// Adds a line that has a word in the column. `end_before` is where the previous word of the
    /// line ends, `blanks` the number of blanks between both words in the source, and `gap` the
    /// least number required.
    void add(std::size_t end_before, std::size_t blanks, std::size_t gap) {
        kept_ = std::min(kept_, end_before + blanks);
        needed_ = std::max(needed_, end_before + gap);
        widest_ = std::max(widest_, end_before);
        fewest_ = std::min(fewest_, blanks);
    }
    std::size_t column() const { return std::max(respelled_ ? widest_ + fewest_ : kept_, needed_); }

private:
    bool respelled_;
    std::size_t kept_ = no_column, needed_ = 0, widest_ = 0, fewest_ = no_column;
};

class Placer {
public:
    Placer(const std::vector<FormatWord>& words, std::vector<FormatLine>& lines, bool respelled)
        : words_(words), lines_(lines), placed_(lines.size()), respelled_(respelled) {}

    void run() {
        for (std::size_t begin = 0; begin < lines_.size();) {
            std::size_t end = begin + 1;
            while (end < lines_.size() && is_below(end)) ++end;
            if (begins_statement(begin)) place_paragraph(begin, end);
            begin = end;
        }
        for (std::size_t line = 0; line < lines_.size(); ++line) place_continued(line);
        place_comments();
    }

private:
    const FormatWord& word(std::size_t line, std::size_t cell) const {
        return words_[lines_[line].cells[cell].word];
    }
    /// Whether words of the line may be aligned with words of the previous line.
    bool is_below(std::size_t line) const {
        return !lines_[line].blank_line_before && begins_statement(line) &&
               begins_statement(line - 1);
    }
    bool begins_statement(std::size_t line) const {
        return !lines_[line].goes_on && !lines_[line].cells.empty();
    }

    void place_paragraph(std::size_t begin, std::size_t end) {
        std::vector<Column> columns = columns_of(begin, end);
        std::stable_sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) {
            return a.source_column < b.source_column;
        });
        for (const Column& column : columns) {
            if (!column.was_stretched) continue;
            Place place(respelled_);
            for (const auto [line, cell] : column.members) {
                place_up_to(line, cell);
                place.add(end_of(line, cell - 1), word(line, cell).blanks, gap(line, cell));
            }
            for (const auto [line, cell] : column.members) {
                lines_[line].cells[cell].column = place.column();
                placed_[line] = cell + 1;
            }
        }
        for (std::size_t line = begin; line < end; ++line) {
            place_up_to(line, lines_[line].cells.size());
        }
    }

    /// The aligned columns in the lines [begin, end), which must be consecutive.
    std::vector<Column> columns_of(std::size_t begin, std::size_t end) {
        struct Candidate {
            std::size_t cell = 0;
            Alignment alignment = Alignment::free;
            /// An index into `columns`, if the word is in a column.
            std::size_t column = no_column;
        };
        std::vector<Column> columns;
        std::vector<Candidate> above;
        for (std::size_t line = begin; line < end; ++line) {
            std::vector<Candidate> here;
            std::size_t depth = 0;
            for (std::size_t cell = 0; cell < lines_[line].cells.size(); ++cell) {
                const Alignment alignment = alignment_of(word(line, cell), depth);
                if (alignment != Alignment::free && cell > 0) here.push_back({cell, alignment});
            }
            std::size_t k = 0;
            for (Candidate& candidate : here) {
                const std::size_t at = word(line, candidate.cell).column;
                while (k < above.size() && word(line - 1, above[k].cell).column < at) ++k;
                const bool meets = k < above.size() && word(line - 1, above[k].cell).column == at &&
                                   above[k].alignment == candidate.alignment;
                if (!meets) continue;
                if (above[k].column == no_column) {
                    above[k].column = columns.size();
                    columns.push_back({{}, at, false});
                    add(columns.back(), line - 1, above[k].cell);
                }
                candidate.column = above[k].column;
                add(columns[candidate.column], line, candidate.cell);
            }
            above = std::move(here);
        }
        return columns;
    }
    void add(Column& column, std::size_t line, std::size_t cell) {
        column.members.push_back({line, cell});
        column.was_stretched = column.was_stretched || word(line, cell).blanks > 1;
    }
    static Alignment alignment_of(const FormatWord& word, std::size_t& depth) {
        switch (word.kind) {
            case TokenKind::open_round:
            case TokenKind::open_square: ++depth; break;
            case TokenKind::close_round:
            case TokenKind::close_square: depth -= depth > 0 ? 1 : 0; break;
            case TokenKind::assign:
            case TokenKind::plus_assign:
                if (depth == 0) return Alignment::relation;
                break;
            case TokenKind::plus:
            case TokenKind::minus:
                if (depth == 0 && !word.is_sign) return Alignment::sum;
                break;
            default: break;
        }
        return Alignment::free;
    }

    std::size_t gap(std::size_t line, std::size_t cell) const {
        return blanks_between(word(line, cell - 1), word(line, cell));
    }
    std::size_t end_of(std::size_t line, std::size_t cell) const {
        return lines_[line].cells[cell].column + width_of(word(line, cell).text);
    }
    /// Sets the columns of a line's cells, from the first cell whose column is not set to the cell
    /// before `end`.
    void place_up_to(std::size_t line, std::size_t end) {
        for (std::size_t& cell = placed_[line]; cell < end; ++cell) {
            lines_[line].cells[cell].column =
                cell == 0 ? lines_[line].indentation : end_of(line, cell - 1) + gap(line, cell);
        }
    }

    // A line that continues a statement begins below the first word after the innermost open
    // bracket. If no bracket is open, the line begins below the start of the statement's value.
    struct Bracket {
        std::size_t inside = 0;  ///< The column at which lines inside the bracket begin.
        /// The column of the closing bracket if it is the first word of a line.
        std::size_t close = 0;
    };

    void place_continued(std::size_t line) {
        FormatLine& here = lines_[line];
        if (here.goes_on) {
            here.indentation = start_of_continued(line);
            place_up_to(line, here.cells.size());
        } else if (!here.cells.empty()) {
            brackets_.clear();
            value_column_ = no_column;
            statement_column_ = here.indentation;
        }
        for (std::size_t cell = 0; cell < here.cells.size(); ++cell) follow(line, cell);
    }
    std::size_t start_of_continued(std::size_t line) const {
        const std::size_t start = helpful_start(line);
        return start <= furthest_start ? start : statement_column_ + goes_on_by;
    }
    std::size_t helpful_start(std::size_t line) const {
        const bool is_comment = lines_[line].cells.empty();
        if (brackets_.empty()) {
            return value_column_ == no_column ? statement_column_ + goes_on_by : value_column_;
        }
        const bool closes = !is_comment && (word(line, 0).kind == TokenKind::close_round ||
                                            word(line, 0).kind == TokenKind::close_square);
        return closes ? brackets_.back().close : brackets_.back().inside;
    }
    void follow(std::size_t line, std::size_t cell) {
        const FormatLine& here = lines_[line];
        const bool is_last = cell + 1 == here.cells.size();
        switch (word(line, cell).kind) {
            case TokenKind::open_round:
            case TokenKind::open_square:
                brackets_.push_back(
                    is_last ? Bracket{here.indentation + 2, here.indentation}
                            : Bracket{here.cells[cell + 1].column, here.cells[cell].column});
                break;
            case TokenKind::close_round:
            case TokenKind::close_square:
                if (!brackets_.empty()) brackets_.pop_back();
                break;
            case TokenKind::semicolon:
            case TokenKind::open_curly: value_column_ = no_column; break;
            case TokenKind::colon:
            case TokenKind::assign:
            case TokenKind::plus_assign:
                if (brackets_.empty() && value_column_ == no_column && !is_last) {
                    value_column_ = here.cells[cell + 1].column;
                }
                break;
            default: break;
        }
    }

    void place_comments() {
        for (std::size_t begin = 0; begin < lines_.size(); ++begin) {
            FormatLine& first = lines_[begin];
            if (!first.comment) continue;
            if (first.cells.empty()) {
                first.comment_column = first.indentation;
                continue;
            }
            std::size_t end = begin;
            Place place(respelled_);
            while (end < lines_.size() && is_in_column(begin, end)) {
                place.add(end_of(end, lines_[end].cells.size() - 1),
                          words_[*lines_[end].comment].blanks, before_comment);
                ++end;
            }
            for (std::size_t line = begin; line < end; ++line) {
                lines_[line].comment_column = place.column();
            }
            begin = end - 1;
        }
    }
    /// Whether the comment of line `line` belongs to the column of comments that begins in line
    /// `first`.
    bool is_in_column(std::size_t first, std::size_t line) const {
        const FormatLine& here = lines_[line];
        if (line == first) return true;
        return here.comment && !here.cells.empty() && !here.blank_line_before &&
               words_[*here.comment].column == words_[*lines_[first].comment].column;
    }

    const std::vector<FormatWord>& words_;
    std::vector<FormatLine>& lines_;
    /// For each line, the number of its cells whose column has been set.
    std::vector<std::size_t> placed_;
    bool respelled_;
    std::vector<Bracket> brackets_;
    std::size_t value_column_ = no_column;
    std::size_t statement_column_ = 0;
};

}  // namespace

void place_words(const std::vector<FormatWord>& words, std::vector<FormatLine>& lines,
                 bool respelled) {
    Placer(words, lines, respelled).run();
}

}  // namespace cascade
