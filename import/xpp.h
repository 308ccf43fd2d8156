// Models of XPPAUT (.ode files): the statements of a file.
#pragma once

#include "import/importer.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::importing {

/// A statement `name = value` of a file, or one equation.
struct XppPair {
    std::string name;  ///< The name in small letters.
    Span place;        ///< The location of the name.
    Span value;        ///< The location of the formula.
    long number = 0;   ///< The value of [j] in the line, if `is_member`.
    bool is_member = false;
};

/// The statements of a file. Its arrays have been recognised.
struct XppFile {
    std::vector<XppPair> parameters, starts, rates, definitions, functions;
    std::map<std::string, std::string> options;  ///< Options such as `@ dt=.05, total=100`.
    /// The indices of the first and the last element of the arrays of species.
    long first = 0, last = 0;
    bool has_arrays = false;
    std::vector<XppPair> ends;  ///< Equations of single elements beside an array, such as u0'.
};

/// Reads the statements. If a script cannot express one of them, reports an error and returns null.
std::optional<XppFile> read_xpp_statements(Import& import);

}  // namespace cascade::importing
