// Quotes only cells that need quotes. Writes numbers that are not finite as empty cells.
#include "core/csv.h"

#include "core/utf8.h"

#include <fmt/format.h>

#include <cmath>

namespace cascade {

std::string csv_row(std::span<const std::string> cells) {
    std::string line;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (k > 0) line += ',';
        const std::string& cell = cells[k];
        if (cell.find_first_of(",\"\r\n") == std::string::npos) {
            line += cell;
            continue;
        }
        line += '"';
        for (const char c : cell) line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
    }
    return line + "\n";
}

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

std::string csv_number(double value, Precision precision) {
    return with_number(precision, [&](auto zero) {
        const auto number = static_cast<decltype(zero)>(value);
        return std::isfinite(number) ? fmt::format("{}", number) : std::string();
    });
}

namespace {

class CsvReader {
public:
    explicit CsvReader(std::string_view text) : text_(text) {
        constexpr std::string_view mark = "\xef\xbb\xbf";
        if (text_.starts_with(mark)) text_.remove_prefix(mark.size());
    }

    Result<std::vector<std::vector<CsvCell>>> read() {
        std::vector<std::vector<CsvCell>> rows;
        while (at_ < text_.size()) {
            std::vector<CsvCell> row;
            do {
                auto cell = read_cell();
                if (!cell) return tl::unexpected(cell.error());
                row.push_back(*std::move(cell));
            } while (take(','));
            end_line();
            const bool is_blank = row.size() == 1 && row[0].text.empty() && !row[0].is_quoted;
            if (!is_blank) rows.push_back(std::move(row));
        }
        return rows;
    }

private:
    static bool is_blank(char c) { return c == ' ' || c == '\t'; }
    static bool ends_line(char c) { return c == '\n' || c == '\r'; }
    bool at_end() const { return at_ == text_.size(); }
    bool take(char wanted) {
        if (at_end() || text_[at_] != wanted) return false;
        ++at_;
        return true;
    }
    void skip_blanks() {
        while (!at_end() && is_blank(text_[at_])) ++at_;
    }
    /// Skips a line end, if there is one.
    void end_line() {
        const bool has_return = take('\r');
        if (!take('\n') && !has_return) return;
        ++line_;
        line_begin_ = at_;
    }
    std::size_t column() const {
        return 1 + count_code_points(text_.substr(line_begin_, at_ - line_begin_));
    }

    Result<CsvCell> read_cell() {
        skip_blanks();
        CsvCell cell{"", line_, column(), take('"')};
        if (cell.is_quoted) {
            if (auto done = read_quoted(cell); !done) return tl::unexpected(done.error());
            return cell;
        }
        const std::size_t begin = at_;
        while (!at_end() && text_[at_] != ',' && !ends_line(text_[at_])) ++at_;
        cell.text = text_.substr(begin, at_ - begin);
        while (!cell.text.empty() && is_blank(cell.text.back())) cell.text.pop_back();
        return cell;
    }

    Result<void> read_quoted(CsvCell& cell) {
        bool is_closed = false;
        while (!at_end() && !is_closed) {
            if (take('"')) {
                is_closed = !take('"');
                if (!is_closed) cell.text += '"';
            } else if (ends_line(text_[at_])) {
                end_line();
                cell.text += '\n';
            } else {
                cell.text += text_[at_++];
            }
        }
        if (!is_closed) {
            return failure(
                fmt::format("{}:{}: this quoted cell has no end", cell.line, cell.column));
        }
        skip_blanks();
        if (at_end() || text_[at_] == ',' || ends_line(text_[at_])) return {};
        return failure(fmt::format("{}:{}: there is text after a quoted cell", line_, column()),
                       "write a quote inside of quotes twice");
    }

    std::string_view text_;
    std::size_t at_ = 0, line_begin_ = 0, line_ = 1;
};

}  // namespace

Result<std::vector<std::vector<CsvCell>>> read_csv(std::string_view text) {
    return CsvReader(text).read();
}

}  // namespace cascade
