// An expression of the command line that may have a name: "NAME=EXPR".
#pragma once

#include <string>

namespace cascade {

struct NamedExpression {
    std::string name;  ///< If the text has no name, the text of the expression.
    std::string expression;
};

/// Divides "NAME=EXPR" at its '='. NAME consists of letters, digits and _, and does not begin with
/// a digit. A text of another form, such as "u == 1", is an expression without a name.
NamedExpression named_expression(const std::string& text);

}  // namespace cascade
