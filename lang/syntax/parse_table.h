// Turns a table of numbers into functions, for use "light.csv".
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"
#include "lang/syntax/ast.h"

#include <cstddef>
#include <string_view>

namespace cascade {

/// The largest number of rows of numbers in a table. Each row becomes a part of an expression.
inline constexpr std::size_t most_table_rows = 1000;

/// The largest size of a table, in bytes.
inline constexpr std::size_t largest_table_text = std::size_t{1} << 20;

/// Whether a file of this name is a table: its name ends with .csv.
bool is_table_name(std::string_view path);

/// Parses comma-separated values (core/csv.h) and adds a function of one number to `script` for
/// each column after the first. Between two rows the function is linear in the numbers of the first
/// column, which must rise, and outside the rows it is constant. The first row may contain the
/// names of the functions, and the row after it may contain units. Text after a ( or [ in a name is
/// a unit. If a table of two columns has no names, its function has the name of the file. Reports
/// errors to `diagnostics`, with the location of the cell.
void parse_table(SourceId source, const Sources& sources, ast::Script& script,
                 Diagnostics& diagnostics);

/// Notes in the script that the names in a used file are unknown because the file could not be
/// read: adds a function without a name. As a result, the check reports no unknown functions and
/// systems.
void add_unknown_names(ast::Script& script, Span use);

}  // namespace cascade
