// Expands subscripts: u_xx becomes dxx(u) if the system has a species or a definition called u and
// has no name u_xx.
#include "lang/check/expressions/expander.h"

#include "lang/vocabulary/subscripts.h"

#include <fmt/format.h>

namespace cascade::checking {

/// The system to which names without a prefix refer. `unknown_system` where operators of fields
/// have no meaning.
SystemId Expander::system_of_names() const {
    const bool has_cells = scope_.context == Context::value || scope_.context == Context::rate ||
                           scope_.context == Context::picture;
    if (!has_cells || is_of_cells(work_, scope_)) return unknown_system;
    if (scope_.context != Context::value || !scope_.stage) return scope_.system;
    return *scope_.stage == 0 ? unknown_system : work_.program.stages[*scope_.stage - 1].system;
}

/// Emits a name, or the derivative that it means. `index` is "[2]" for a member of a family, else
/// empty. `word` is the source location of the name without its index.
void Expander::emit_name(Span span, Span word, std::string_view name, std::string_view index) {
    const auto indexed = [&](std::string_view each) -> std::string_view {
        return index.empty() ? each : out_.names.emplace_back(fmt::format("{}{}", each, index));
    };
    const std::string_view whole = indexed(name);
    const auto subscripted = subscripted_name(name);
    const SystemId system = subscripted ? system_of_names() : unknown_system;
    const bool is_derivative = system != unknown_system &&
                               find(work_.names[system], whole) == nullptr &&
                               find_subject(work_, system, indexed(subscripted->of)).has_value();
    if (!is_derivative) return emit(span, ast::Name{whole});
    const std::uint32_t end = word.end - static_cast<std::uint32_t>(subscripted->axes.size() + 1);
    emit({word.source, word.begin, end}, ast::Name{indexed(subscripted->of)});
    differentiate(span, subscripted->axes);
}

/// Emits a name in the body of a function. If the name is a parameter with a subscript, emits the
/// derivative of the parameter.
void Expander::visit_subscripted(Span span, const ast::Name& name) {
    const auto subscripted = subscripted_name(name.name);
    const Frame& frame = frames_.back();
    const auto parameter =
        frame.function->parameters.find(subscripted ? subscripted->of : std::string_view());
    if (parameter == frame.function->parameters.end()) return emit(span, name);
    results_.push_back(arguments_[frame.first_argument + parameter->second]);
    differentiate(span, subscripted->axes);
}

/// Replaces the last result by its derivative along the axes.
void Expander::differentiate(Span span, std::string_view axes) {
    if (axes.size() > most_subscripts) {
        take();
        return error(span,
                     fmt::format("subscripts may name at most {} derivatives, not {}",
                                 most_subscripts, axes.size()),
                     "");
    }
    for (const Function function : derivatives_along(axes)) {
        const auto first = static_cast<std::uint32_t>(out_.parts.arguments.size());
        out_.parts.arguments.push_back(take());
        emit(span, ast::Call{{span, info(function).spelling}, first, 1});
    }
}

}  // namespace cascade::checking
