// Options of other programs, and their replacements in Cascade.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cascade {

/// Advice about `option`, such as `--dt` or `--dt=0.1`, which the command does not have: the
/// replacement, with the value that the user has given or an example. `is_option` tells whether the
/// command has an option of this name, and `has_near` whether it has one with a similar name. In
/// that case `option` is not taken for the name of a value of the script. Empty if there is no
/// advice.
std::string advice_about_option(std::string_view option, const std::string& value,
                                const std::function<bool(std::string_view)>& is_option,
                                bool has_near);

}  // namespace cascade
