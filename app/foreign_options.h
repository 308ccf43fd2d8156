// Replaces options of other programs by options of Cascade.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cascade {

/// Returns advice about `option`, such as `--dt` or `--dt=0.1`, which the command does not have.
/// The advice names the replacement, with the value that the user has given or with an example. If
/// the option is unknown but may be the name of a value of the script, the advice is to use --set.
/// `is_option` tells whether the command has an option of this name. If `has_near` is true, the
/// command has an option with a similar name, and `option` is not taken for the name of a value.
/// Returns an empty string if there is no advice.
std::string advice_about_option(std::string_view option, const std::string& value,
                                const std::function<bool(std::string_view)>& is_option,
                                bool has_near);

}  // namespace cascade
