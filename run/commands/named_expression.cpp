// Only the first '=' of a text can end a name, and only if it is not part of "==", which compares.
#include "run/commands/named_expression.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

/// Returns the position of the '=' in "NAME=EXPR", or 0 if the text has no name.
std::size_t end_of_name(std::string_view text) {
    const auto is_of_name = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    const auto end = std::find_if_not(text.begin(), text.end(), is_of_name);
    const auto equals = std::find_if(end, text.end(), [](char c) { return c != ' '; });
    const bool is_name = end != text.begin() && !std::isdigit(static_cast<unsigned char>(text[0]));
    const auto at = static_cast<std::size_t>(equals - text.begin());
    return is_name && text.substr(at, 1) == "=" && text.substr(at, 2) != "==" ? at : 0;
}

}  // namespace

NamedExpression named_expression(const std::string& text) {
    const std::size_t equals = end_of_name(text);
    if (equals == 0) return {text, text};
    std::string value = text.substr(equals + 1);
    value.erase(0, value.find_first_not_of(' '));
    return {text.substr(0, text.find_first_of(" =")), std::move(value)};
}

}  // namespace cascade
