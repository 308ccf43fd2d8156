// If a request is refused, the messages about the text of the request are printed before the error.
#include "run/session/refusal.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

std::string Refusal::messages(bool colour) const {
    RenderStyle style;
    style.colour = colour;
    std::string text = render(diagnostics, sources, style);
    if (!failure) return text;
    text += fmt::format("{}\n", failure->message);
    if (!failure->hint.empty()) text += fmt::format("  {}\n", failure->hint);
    return text;
}

Failure Refusal::in_brief() const {
    if (failure) return *failure;
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        if (diagnostic.severity == Severity::error) return {diagnostic.message, diagnostic.hint};
    }
    return {};
}

tl::unexpected<Refusal> refuse(Failure failure) {
    Refusal refused;
    refused.failure = std::move(failure);
    return tl::unexpected(std::move(refused));
}

tl::unexpected<Refusal> refuse(std::string message, std::string hint) {
    return refuse(Failure{std::move(message), std::move(hint)});
}

tl::unexpected<Refusal> refuse(Script script, std::optional<Failure> failure) {
    Refusal refused;
    refused.diagnostics = std::move(script.diagnostics);
    refused.sources = std::move(script.sources);
    // If there are errors, the failure would only repeat them.
    if (!refused.diagnostics.has_errors()) refused.failure = std::move(failure);
    return tl::unexpected(std::move(refused));
}

}  // namespace cascade
