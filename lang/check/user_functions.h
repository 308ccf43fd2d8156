// Functions that a script defines, `fn bump(r, w) = exp(-(r/w)^2)` (internal to the checker).
//
// A function reads its parameters, built-in values and other functions and nothing else; it never
// calls itself, directly or through others. So a call can be written out: the function's value with
// the arguments in the place of the parameters.
#pragma once

#include "lang/check/check_names.h"

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace cascade::checking {

struct UserFunction {
    const ast::FunctionDefinition* definition = nullptr;
    std::unordered_map<std::string_view, std::uint32_t> parameters;  ///< Their numbers, from 0.
    bool faulty = false;  ///< A message has been given; calls stay silent.
};

/// The functions of one script, by name.
class FunctionTable {
public:
    /// Null where the script has no function of this name.
    const UserFunction* find(std::string_view name) const {
        const auto found = by_name_.find(name);
        return found == by_name_.end() ? nullptr : &functions_[found->second];
    }
    bool empty() const { return functions_.empty(); }
    std::vector<std::string> names() const;

private:
    friend class FunctionTableMaker;
    std::vector<UserFunction> functions_;
    std::unordered_map<std::string_view, std::uint32_t> by_name_;
};

/// Is this the name of a function of the language, or of what is taken over an index?
bool is_function_name(std::string_view name);

/// Says that there is no such function; `own` are the names of the script's functions.
void report_unknown_function(Workspace& work, const ast::Word& name,
                             const std::vector<std::string>& own);

/// Whether a call has as many arguments as the function has parameters; if not, with a message.
bool has_right_count(Workspace& work, const UserFunction& function, const ast::Call& call,
                     Span span);

/// The functions of a script; checked, with messages, when they are asked for first.
const FunctionTable& functions_of(Workspace& work, const ast::Script& script);

}  // namespace cascade::checking
