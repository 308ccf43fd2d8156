// Checks the functions and constants of a script: their names, and the names that they read. Also
// checks that no function is recursive.
#include "lang/check/expressions/user_functions.h"

#include "core/counted.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/check/names/domain_lengths.h"
#include "lang/program/order.h"
#include "lang/vocabulary/settings.h"
#include "lang/vocabulary/subscripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace cascade::checking {

namespace {

constexpr const char* what_functions_read =
    "a function can read only its parameters, constants and built-in values";
constexpr const char* what_constants_read =
    "a constant can read only built-in values and other "
    "constants";

const char* what_it_reads(const UserFunction& function) {
    return function.definition->is_constant ? what_constants_read : what_functions_read;
}

const char* kind_of(const UserFunction& function) {
    return function.definition->is_constant ? "constant" : "function";
}

}  // namespace

std::vector<std::string> FunctionTable::names() const {
    std::vector<std::string> names;
    for (const auto& [name, index] : by_name_) names.emplace_back(name);
    std::sort(names.begin(), names.end());
    return names;
}

bool lacks_names(const ast::Script& script) {
    return std::ranges::any_of(script.functions, [](const ast::FunctionDefinition& function) {
        return function.name.empty();
    });
}

class FunctionTableMaker {
public:
    FunctionTableMaker(Workspace& work, const ast::Script& script) : work_(work), script_(script) {}

    FunctionTable run() {
        for (const ast::FunctionDefinition& definition : script_.functions) declare(definition);
        calls_.resize(table_.functions_.size());
        for (std::uint32_t i = 0; i < table_.functions_.size(); ++i) check_body(i);
        for (const auto& cycle : topological_order(calls_).cycles) report_cycle(cycle);
        return std::move(table_);
    }

private:
    void declare(const ast::FunctionDefinition& definition);
    void check_body(std::uint32_t index);
    ast::Expression body_of(const ast::FunctionDefinition& definition) const;
    void check_name(std::uint32_t index, std::string_view name, Span span);
    void check_call(std::uint32_t index, const ast::Call& call, Span span);
    void report_cycle(const std::vector<std::uint32_t>& cycle);
    /// The library function of cells with this name. Null while the library functions themselves
    /// are checked.
    const UserFunction* find_of_cells(std::string_view name) {
        const ast::Script* of_cells = work_.cell_functions;
        if (of_cells == nullptr || of_cells == &script_) return nullptr;
        return functions_of(work_, *of_cells).find(name);
    }
    void error(UserFunction& function, Span span, std::string message, std::string hint) {
        work_.diagnostics.error(span, std::move(message), std::move(hint));
        function.has_error = true;
    }

    Workspace& work_;
    const ast::Script& script_;
    FunctionTable table_;
    Dependencies calls_;
};

void FunctionTableMaker::declare(const ast::FunctionDefinition& definition) {
    if (definition.name.empty()) return;
    UserFunction function;
    function.definition = &definition;
    function.body = body_of(definition);
    const ast::Word& name = definition.name;
    if (is_function_name(name.text)) {
        work_.diagnostics.error(name.span,
                                fmt::format("'{}' is a function of the language", name.text),
                                "choose another name");
        return;
    }
    if (definition.is_constant && (reserved(name.text) != Reserved::no ||
                                   cell_value_named(name.text) || is_of_each_cell(name.text))) {
        work_.diagnostics.error(name.span, fmt::format("'{}' is a word of the language", name.text),
                                "choose another name");
        return;
    }
    for (const ast::Word& parameter : definition.parameters) {
        const auto number = static_cast<std::uint32_t>(function.parameters.size());
        const auto [first, is_new] = function.parameters.try_emplace(parameter.text, number);
        if (is_new) continue;
        report_twice(work_, parameter.span, definition.parameters[first->second].span,
                     fmt::format("'{}' is listed twice as a parameter", parameter.text));
        function.has_error = true;
    }
    const auto index = static_cast<std::uint32_t>(table_.functions_.size());
    const auto [first, is_new] = table_.by_name_.try_emplace(name.text, index);
    if (!is_new) {
        report_twice(work_, name.span, table_.functions_[first->second].definition->name.span,
                     fmt::format("there are two {} '{}'",
                                 definition.is_constant ? "constants" : "functions", name.text));
    }
    table_.functions_.push_back(std::move(function));
}

/// The body of a function. For a constant, the last `--set` that sets it without naming a stage
/// replaces the body.
ast::Expression FunctionTableMaker::body_of(const ast::FunctionDefinition& definition) const {
    ast::Expression body = definition.body;
    if (!definition.is_constant) return body;
    for (const ast::Override& change : script_.overrides) {
        if (const auto* constant = constant_statement(change);
            constant != nullptr && constant->name.text == definition.name.text) {
            body = constant->values.front();
        }
    }
    return body;
}

void FunctionTableMaker::check_body(std::uint32_t index) {
    UserFunction& function = table_.functions_[index];
    const ast::Expression body = function.body;
    const bool is_constant = function.definition->is_constant;
    const std::string kind = kind_of(function);
    std::vector<bool> is_family(body.root - body.first + 1, false);
    for (ast::ExprId id = body.first; id <= body.root; ++id) {
        const auto* member = std::get_if<ast::Indexed>(&script_.expressions[id].node);
        if (member != nullptr) is_family[member->base - body.first] = true;
    }
    for (ast::ExprId id = body.first; id <= body.root; ++id) {
        const ast::Expr& part = script_.expressions[id];
        // The member is reported together with its index.
        if (is_family[id - body.first]) continue;
        // The length is checked in each call.
        if (name_of_length(script_, part) != nullptr) continue;
        if (const auto* name = std::get_if<ast::Name>(&part.node)) {
            check_name(index, name->name, part.span);
        } else if (const auto* call = std::get_if<ast::Call>(&part.node)) {
            check_call(index, *call, part.span);
        } else if (const auto* over = std::get_if<ast::Over>(&part.node)) {
            const std::string_view what = over->index.text;
            if (what != "domain" && what != "touching" && what != "near") {
                error(function, over->index.span,
                      fmt::format("a {} has no index '{}'", kind, over->index.text),
                      is_constant ? what_constants_read
                                  : "pass the members or their sum as arguments");
            }
        } else if (std::holds_alternative<ast::Garbage>(part.node)) {
            function.has_error = true;
        } else if (std::holds_alternative<ast::Indexed>(part.node)) {
            error(function, part.span, fmt::format("a {} cannot read a member of a family", kind),
                  is_constant ? what_constants_read : "pass the member as an argument");
        } else if (std::holds_alternative<ast::Bracketed>(part.node) ||
                   std::holds_alternative<ast::Qualified>(part.node) ||
                   std::holds_alternative<ast::RateOf>(part.node)) {
            error(function, part.span, fmt::format("a {} cannot read a stage or a system", kind),
                  what_it_reads(function));
        }
    }
}

void FunctionTableMaker::check_name(std::uint32_t index, std::string_view name, Span span) {
    UserFunction& function = table_.functions_[index];
    if (function.parameters.contains(name) || name == domain_word) return;
    const auto parts = subscripted_name(name);
    if (parts && function.parameters.contains(parts->of)) return;
    if (const UserFunction* constant = table_.find_constant(name)) {
        calls_[index].push_back(static_cast<std::uint32_t>(constant - table_.functions_.data()));
        return;
    }
    const Reserved kind = reserved(name);
    if (kind == Reserved::builtin || cell_value_named(name)) return;
    if (work_.cell_functions != nullptr && is_of_each_cell(name)) return;
    std::vector<std::string> names;
    for (const ast::Word& each : function.definition->parameters) names.emplace_back(each.text);
    for (const UserFunction& each : table_.functions_) {
        if (each.definition->is_constant) names.emplace_back(each.definition->name.text);
    }
    std::string hint = did_you_mean(work_, name, names);
    if (hint.empty()) hint = what_it_reads(function);
    const std::string_view own = function.definition->name.text;
    error(function, span,
          function.definition->is_constant
              ? fmt::format("'{}' is not known where the constant '{}' is defined", name, own)
              : fmt::format("'{}' is not a parameter of the function '{}'", name, own),
          std::move(hint));
}

void FunctionTableMaker::check_call(std::uint32_t index, const ast::Call& call, Span span) {
    UserFunction& caller = table_.functions_[index];
    if (const UserFunction* called = table_.find(call.function.text)) {
        calls_[index].push_back(static_cast<std::uint32_t>(called - table_.functions_.data()));
        if (!has_right_count(work_, *called, call, span)) caller.has_error = true;
    } else if (const UserFunction* of_cells = find_of_cells(call.function.text)) {
        if (!has_right_count(work_, *of_cells, call, span)) caller.has_error = true;
    } else if (!is_function_name(call.function.text)) {
        caller.has_error = true;
        if (!lacks_names(script_)) {
            report_unknown_function(work_, call.function, table_.names());
        }
    }
}

void FunctionTableMaker::report_cycle(const std::vector<std::uint32_t>& cycle) {
    std::vector<std::string> names;
    bool has_constant = false;
    for (const std::uint32_t function : cycle) {
        table_.functions_[function].has_error = true;
        names.emplace_back(table_.functions_[function].definition->name.text);
        has_constant |= table_.functions_[function].definition->is_constant;
    }
    // Finds where the first function of the cycle calls the next function (or itself, if it is the
    // only one).
    const ast::Expression body = table_.functions_[cycle[0]].body;
    const std::string& next = names[1 % names.size()];
    Span span = table_.functions_[cycle[0]].definition->name.span;
    for (ast::ExprId id = body.first; id <= body.root; ++id) {
        const ast::Expr& part = script_.expressions[id];
        const auto* call = std::get_if<ast::Call>(&part.node);
        const auto* name = std::get_if<ast::Name>(&part.node);
        if (call != nullptr && call->function.text == next) span = call->function.span;
        if (name != nullptr && name->name == next) span = part.span;
    }
    const char* const reads = has_constant ? "reads" : "calls";
    const std::string message =
        cycle.size() == 1 ? fmt::format("the {} '{}' {} itself",
                                        kind_of(table_.functions_[cycle[0]]), names[0], reads)
                          : fmt::format("{} each other in a cycle: {}",
                                        has_constant ? "constants read" : "functions call",
                                        describe_cycle(names));
    work_.diagnostics.error(span, message,
                            fmt::format("{} cannot be recursive",
                                        has_constant ? "constants" : "functions"));
}

const FunctionTable& functions_of(Workspace& work, const ast::Script& script) {
    std::shared_ptr<const FunctionTable>& table = work.functions[&script];
    if (table == nullptr) {
        table = std::make_shared<const FunctionTable>(FunctionTableMaker(work, script).run());
    }
    return *table;
}

FoundFunction find_function(Workspace& work, const ast::Script& script, std::string_view name) {
    if (const UserFunction* own = functions_of(work, script).find(name)) return {own, &script};
    if (work.cell_functions == nullptr) return {};
    const UserFunction* of_cells = functions_of(work, *work.cell_functions).find(name);
    return {of_cells, work.cell_functions};
}

bool has_right_count(Workspace& work, const UserFunction& function, const ast::Call& call,
                     Span span) {
    const std::size_t count = function.definition->parameters.size();
    if (call.argument_count == count) return true;
    std::string form = fmt::format("{}(", function.definition->name.text);
    for (const ast::Word& parameter : function.definition->parameters) {
        if (&parameter != &function.definition->parameters.front()) form += ", ";
        form += parameter.text;
    }
    work.diagnostics.error(span,
                           fmt::format("{} takes {}, not {}", function.definition->name.text,
                                       counted(count, "value"), call.argument_count),
                           "the definition is " + form + ")");
    return false;
}

void check_names_of_constants(Workspace& work, const ast::Script& script) {
    const FunctionTable& functions = functions_of(work, script);
    for (const ast::FunctionDefinition& definition : script.functions) {
        const ast::Word& name = definition.name;
        if (functions.find_constant(name.text) == nullptr) continue;
        for (const SystemId id : work.names.ids()) {
            const System& system = work.program.systems[id];
            const bool is_index = std::ranges::any_of(system.indices, [&](const Index& index) {
                return index.name == name.text;
            });
            if (!is_index && find(work.names[id], name.text) == nullptr) continue;
            work.diagnostics.error(name.span,
                                   fmt::format("'{}' is also a name in {}", name.text, system.name),
                                   "choose another name");
            break;
        }
    }
}

}  // namespace cascade::checking
