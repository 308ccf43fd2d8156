// Makes functions of tables. The expression of a function is a tree of `if`, which finds the two
// rows around a number with log₂(rows) comparisons.
#include "lang/syntax/parse_table.h"

#include "core/counted.h"
#include "core/csv.h"
#include "core/decimal.h"
#include "core/printable.h"
#include "core/utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

namespace {

constexpr std::string_view argument_of_tables = "t";

std::optional<double> number_in(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = from_decimal(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
    return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The name in a cell such as "light [lux]". Empty if a function cannot have this name.
std::string_view function_name(std::string_view text) {
    text = text.substr(0, text.find_first_of("(["));
    while (text.ends_with(' ')) text.remove_suffix(1);
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    const bool is_name = !text.empty() && is_letter(text.front()) &&
                         std::all_of(text.begin(), text.end(), [&](char c) {
                             return is_letter(c) || (c >= '0' && c <= '9');
                         });
    return is_name ? text : std::string_view();
}

/// The file name in a path, without folders and extension.
std::string_view stem_of(std::string_view path) {
    path.remove_prefix(path.find_last_of("/\\") + 1);
    return path.substr(0, path.rfind('.'));
}

/// A table of numbers, column by column, with the span of each cell.
struct NumberTable {
    std::vector<std::vector<double>> columns;
    std::vector<std::vector<Span>> spans;
};

class TableParser {
public:
    TableParser(SourceId source, const Sources& sources, ast::Script& script,
                Diagnostics& diagnostics)
        : source_(source),
          text_(sources[source].text()),
          stem_(stem_of(sources[source].name())),
          script_(script),
          diagnostics_(diagnostics) {
        lines_.push_back(text_.starts_with("\xef\xbb\xbf") ? 3 : 0);
        for (std::size_t k = 0; k < text_.size(); ++k) {
            const bool ends =
                text_[k] == '\n' || (text_[k] == '\r' && !text_.substr(k + 1).starts_with('\n'));
            if (ends) lines_.push_back(k + 1);
        }
    }

    void run() {
        if (read()) {
            for (std::size_t column = 1; column < names_.size(); ++column) add(column);
            return;
        }
        if (names_.size() < 2) return add_unknown_names(script_, {source_, 0, 0});
        for (std::size_t column = 1; column < names_.size(); ++column) add_damaged(column);
    }

private:
    bool read();
    bool take_names();
    bool take_numbers();
    bool take_row(const std::vector<CsvCell>& row);
    void add(std::size_t column);
    void add_damaged(std::size_t column);
    ast::ExprId between(std::size_t column, std::size_t first, std::size_t last);
    ast::ExprId piece(std::size_t column, std::size_t number);

    bool refuse(Span span, std::string message, std::string hint = "") {
        diagnostics_.error(span, std::move(message), std::move(hint));
        return false;
    }
    bool refuse_text(const Failure& failure);
    Span span_of(const CsvCell& cell) const;
    ast::ExprId node(Span span, decltype(ast::Expr::node) kind) {
        script_.expressions.push_back({span, std::move(kind)});
        return static_cast<ast::ExprId>(script_.expressions.size() - 1);
    }
    ast::ExprId argument(Span span) { return node(span, ast::Name{argument_of_tables}); }

    SourceId source_;
    std::string_view text_, stem_;
    ast::Script& script_;
    Diagnostics& diagnostics_;
    std::vector<std::size_t> lines_;  ///< The position of the first byte of each line.
    std::vector<std::vector<CsvCell>> rows_;
    std::size_t first_row_ = 0;  ///< The index of the first row of numbers.
    /// For each column, the name of its function. The name of the first column is not used.
    std::vector<ast::Word> names_;
    NumberTable table_;
};

/// The span of a cell in bytes. CsvCell gives the line and column of the cell in characters.
Span TableParser::span_of(const CsvCell& cell) const {
    std::size_t at = lines_[cell.line - 1];
    for (std::size_t column = 1; column < cell.column; ++column) {
        at += decode_utf8(text_, at).size;
    }
    const std::size_t rest = text_.substr(at + (cell.is_quoted ? 1 : 0)).starts_with(cell.text)
                                 ? cell.text.size() + (cell.is_quoted ? 2 : 0)
                                 : 1;
    return {source_, static_cast<std::uint32_t>(at),
            static_cast<std::uint32_t>(std::min(at + rest, text_.size()))};
}

/// Reports an error of read_csv(). The error's message begins with "LINE:COLUMN: ".
bool TableParser::refuse_text(const Failure& failure) {
    CsvCell place;
    const std::string_view message = failure.message;
    const std::size_t colon = message.find(':'), end = message.find(": ");
    std::from_chars(message.data(), message.data() + colon, place.line);
    std::from_chars(message.data() + colon + 1, message.data() + end, place.column);
    return refuse(span_of(place), std::string(message.substr(end + 2)), failure.hint);
}

bool TableParser::read() {
    if (text_.size() > largest_table_text) {
        return refuse({source_, 0, 0},
                      fmt::format("this table has {} bytes, but at most {} can be read",
                                  text_.size(), largest_table_text));
    }
    auto rows = read_csv(text_);
    if (!rows) return refuse_text(rows.error());
    rows_ = *std::move(rows);
    return take_names() && take_numbers();
}

/// Finds the names of the functions, and the first row of numbers.
bool TableParser::take_names() {
    const Span whole{source_, 0, 0};
    if (rows_.empty())
        return refuse(whole, "this table is empty",
                      "write rows of a time and a "
                      "value, such as 0,1.5");
    const auto& head = rows_.front();
    const Span first = span_of(head.front());
    if (head.size() == 1) {
        const bool has_semicolons = head.front().text.find_first_of(";\t") != std::string::npos;
        return refuse(first,
                      has_semicolons ? "the cells of a table must be separated by commas"
                                     : "this table has one column",
                      has_semicolons ? "write 0,1.5 in place of 0;1.5"
                                     : "the first column has times, and the others have values");
    }
    if (number_in(head.front().text)) {
        if (head.size() > 2) {
            return refuse(first,
                          "this table has several columns of values, but its first row "
                          "does not name them",
                          "write a first row with names, such as time,lamp,shade");
        }
        if (function_name(stem_) != stem_) {
            return refuse(first,
                          fmt::format("'{}' cannot be the name of a function",
                                      printable(std::string(stem_))),
                          "write a first row with another name, such as time,lamp");
        }
        names_ = {{}, {first, stem_}};
        return true;
    }
    for (const CsvCell& cell : head) {
        const Span span = span_of(cell);
        const std::string_view name = function_name(cell.text);
        if (name.empty() && &cell != &head.front()) {
            return refuse(
                span, fmt::format("'{}' cannot be the name of a function", printable(cell.text)),
                "a name has letters, digits and _, as in time,lamp_2");
        }
        const std::size_t begin = span.begin + (cell.is_quoted ? 1 : 0);
        names_.push_back({{source_, static_cast<std::uint32_t>(begin),
                           static_cast<std::uint32_t>(begin + name.size())},
                          text_.substr(begin, name.size())});
    }
    first_row_ = 1;
    const bool has_units =
        rows_.size() > 1 && std::none_of(rows_[1].begin(), rows_[1].end(), [](const CsvCell& cell) {
            return number_in(cell.text).has_value();
        });
    if (has_units) first_row_ = 2;
    return true;
}

bool TableParser::take_numbers() {
    const std::size_t count = rows_.size() - first_row_;
    if (count < 2) {
        return refuse(span_of(rows_.back().front()),
                      fmt::format("this table has {} of numbers",
                                  counted(static_cast<std::int64_t>(count), "row")),
                      "a table needs at least two rows of numbers");
    }
    if (count > most_table_rows) {
        return refuse(span_of(rows_[first_row_ + most_table_rows].front()),
                      fmt::format("this table has {} rows of numbers, but at most {} can be read",
                                  count, most_table_rows),
                      "leave out rows between which the values are nearly linear");
    }
    table_.columns.resize(names_.size());
    table_.spans.resize(names_.size());
    for (std::size_t row = first_row_; row < rows_.size(); ++row) {
        if (!take_row(rows_[row])) return false;
    }
    return true;
}

bool TableParser::take_row(const std::vector<CsvCell>& row) {
    if (row.size() != names_.size()) {
        const CsvCell& there = row.size() < names_.size() ? row.back() : row[names_.size()];
        return refuse(span_of(there),
                      fmt::format("this row has {}, but the first row has {}",
                                  counted(static_cast<std::int64_t>(row.size()), "cell"),
                                  names_.size()));
    }
    for (std::size_t column = 0; column < row.size(); ++column) {
        const Span span = span_of(row[column]);
        const auto number = number_in(row[column].text);
        if (!number) {
            return refuse(span,
                          row[column].text.empty()
                              ? std::string("there is no number in this cell")
                              : fmt::format("'{}' is not a number", printable(row[column].text)),
                          "every cell below the names is a number such as 0.025 or 2e-3");
        }
        auto& numbers = table_.columns[column];
        if (column == 0 && !numbers.empty() && !(*number > numbers.back())) {
            return refuse(span, fmt::format("{} comes after {}, but the first column must rise",
                                            row[0].text, numbers.back()));
        }
        numbers.push_back(*number);
        table_.spans[column].push_back(span);
    }
    return true;
}

/// Adds the function of a column to the script.
void TableParser::add(std::size_t column) {
    ast::FunctionDefinition function;
    function.name = names_[column];
    function.parameters = {{names_[column].span, argument_of_tables}};
    function.body.first = static_cast<ast::ExprId>(script_.expressions.size());
    function.body.root = between(column, 0, table_.columns[0].size());
    function.span = names_[column].span;
    function.doc = fmt::format("The column '{}' of a table.", function.name.text);
    script_.functions.push_back(std::move(function));
}

/// Adds a function without a value, so that calls of the function are not reported as well.
void TableParser::add_damaged(std::size_t column) {
    ast::FunctionDefinition function;
    function.name = names_[column];
    function.body.first = function.body.root = node(names_[column].span, ast::Garbage{});
    script_.functions.push_back(std::move(function));
}

/// Adds the expression for the pieces `first` … `last`, and returns its root. A piece is the part
/// of the function between two rows. Piece k ends at row k. The piece after the last row has no
/// end.
ast::ExprId TableParser::between(std::size_t column, std::size_t first, std::size_t last) {
    if (first == last) return piece(column, first);
    const std::size_t middle = (first + last) / 2;
    const Span span = table_.spans[0][middle];
    const ast::ExprId here = argument(span);
    const ast::ExprId end = node(span, ast::Number{table_.columns[0][middle]});
    const ast::ExprId is_before = node(span, ast::Binary{Function::less, here, end});
    const ast::ExprId before = between(column, first, middle);
    const ast::ExprId after = between(column, middle + 1, last);
    const auto arguments = static_cast<std::uint32_t>(script_.arguments.size());
    script_.arguments.insert(script_.arguments.end(), {is_before, before, after});
    return node(span, ast::Call{{span, "if"}, arguments, 3});
}

/// Adds the expression for one piece. The first and the last piece, which are outside of the rows,
/// are constant. Any other piece is linear between two rows.
ast::ExprId TableParser::piece(std::size_t column, std::size_t number) {
    const auto& times = table_.columns[0];
    const auto& values = table_.columns[column];
    const std::size_t row = number > 0 ? number - 1 : 0;
    const Span span = table_.spans[column][row];
    const ast::ExprId value = node(span, ast::Number{values[row]});
    if (number == 0 || number == times.size() || values[row] == values[number]) return value;
    const double slope = (values[number] - values[row]) / (times[number] - times[row]);
    const ast::ExprId slope_node = node(span, ast::Number{slope});
    const ast::ExprId here = argument(span);
    const ast::ExprId begin = node(span, ast::Number{times[row]});
    const ast::ExprId since = node(span, ast::Binary{Function::subtract, here, begin});
    const ast::ExprId change = node(span, ast::Binary{Function::multiply, slope_node, since});
    return node(span, ast::Binary{Function::add, value, change});
}

}  // namespace

void add_unknown_names(ast::Script& script, Span use) {
    ast::FunctionDefinition function;
    function.name.span = use;
    function.body.first = function.body.root = static_cast<ast::ExprId>(script.expressions.size());
    script.expressions.push_back({use, ast::Garbage{}});
    script.functions.push_back(std::move(function));
}

bool is_table_name(std::string_view path) {
    return path.ends_with(".csv") || path.ends_with(".CSV");
}

void parse_table(SourceId source, const Sources& sources, ast::Script& script,
                 Diagnostics& diagnostics) {
    TableParser(source, sources, script, diagnostics).run();
}

}  // namespace cascade
