// Functions and constants that a script defines, such as `fn bump(r, w) = exp(-(r/w)^2)` and `let L
// = 10` (internal to the checker).
//
// A function reads only its parameters, built-in values, constants and other functions, and is not
// recursive. So a call can be expanded, that is, replaced by the function's body with the arguments
// in place of the parameters. A constant is a function without parameters that is read without
// brackets.
#pragma once

#include "lang/check/names/check_names.h"

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace cascade::checking {

struct UserFunction {
    const ast::FunctionDefinition* definition = nullptr;
    /// The body in the definition. If `--set` changes a constant, the new value.
    ast::Expression body;
    /// The index of each parameter, by its name.
    std::unordered_map<std::string_view, std::uint32_t> parameters;
    /// Whether an error in the function has been reported. Calls of the function then cause no
    /// further messages.
    bool has_error = false;
};

/// The functions of one script, by name.
class FunctionTable {
public:
    /// The function with this name; null if the script has none.
    const UserFunction* find(std::string_view name) const {
        const auto found = by_name_.find(name);
        return found == by_name_.end() ? nullptr : &functions_[found->second];
    }
    /// The constant with this name; null if the script has none.
    const UserFunction* find_constant(std::string_view name) const {
        const UserFunction* found = find(name);
        return found != nullptr && found->definition->is_constant ? found : nullptr;
    }
    bool empty() const { return functions_.empty(); }
    std::vector<std::string> names() const;

private:
    friend class FunctionTableMaker;
    std::vector<UserFunction> functions_;
    std::unordered_map<std::string_view, std::uint32_t> by_name_;
};

/// Whether the names of some functions or systems are unknown, because a used file or the name of a
/// function could not be read.
bool lacks_names(const ast::Script& script);

/// A function and the script in which it is defined.
struct FoundFunction {
    const UserFunction* function = nullptr;
    const ast::Script* script = nullptr;
    explicit operator bool() const { return function != nullptr; }
};

/// The function to which a call in `script` refers: a function of the script or, if the script has
/// none of this name, a library function of cells. Empty if neither exists.
FoundFunction find_function(Workspace& work, const ast::Script& script, std::string_view name);

/// Whether the name is a function of the language or an aggregate over an index.
bool is_function_name(std::string_view name);

/// Reports that there is no function of this name. `own` are the names of the script's functions.
void report_unknown_function(Workspace& work, const ast::Word& name,
                             const std::vector<std::string>& own);

/// Whether a call has as many arguments as the function has parameters. Reports an error if not.
bool has_right_count(Workspace& work, const UserFunction& function, const ast::Call& call,
                     Span span);

/// The functions and constants of a script. They are checked when they are first requested.
const FunctionTable& functions_of(Workspace& work, const ast::Script& script);

/// Reports constants that have the same name as a parameter, definition or index of a system,
/// because a reader could not tell which of the two an expression means.
void check_names_of_constants(Workspace& work, const ast::Script& script);

}  // namespace cascade::checking
