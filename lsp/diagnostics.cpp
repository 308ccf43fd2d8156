// Errors and warnings, and the edits that their hints suggest.
#include "core/counted.h"
#include "lang/service/advice.h"
#include "lsp/answers.h"
#include "run/commands/outlooks.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::lsp {
namespace {

constexpr int severity_error = 1, severity_warning = 2, severity_information = 3;
/// Fixes are limited, because each fix requires a check of the whole text.
constexpr std::size_t most_fixes = 5, largest_fixed_text = std::size_t{1} << 16;

/// The span in the document's own text at which a diagnostic is shown. For a diagnostic in a file
/// that the script uses, this is the span of the file's name in the script.
Span own_span(const Script& script, Span span) {
    if (span.source == own_source) return span;
    const std::string& name = script.sources[span.source].name();
    Span found;
    for (const ast::Use& use : script.tree.uses) {
        if (use.span.source != own_source) continue;
        if (found.end == 0 || name.ends_with(use.path)) found = use.span;
    }
    return found;
}

std::string with_hint(std::string message, const std::string& hint) {
    return hint.empty() ? message : std::move(message) + "\n" + hint;
}

Json related(Document& document, Span span, const std::string& message) {
    Json location = location_of(document, span);
    if (location.is_null()) return location;
    return {{"location", std::move(location)}, {"message", message}};
}

Json json_of(Document& document, const Diagnostic& diagnostic) {
    const Script& script = document.script();
    Json notes = Json::array();
    std::string message = with_hint(diagnostic.message, diagnostic.hint);
    if (diagnostic.span.source != own_source) {
        const Source& source = script.sources[diagnostic.span.source];
        const Location at = source.locate(diagnostic.span.begin);
        const auto file = std::filesystem::path(source.name()).filename().string();
        message = fmt::format("{}:{}:{}: {}", file, at.line, at.column, message);
        notes.push_back(related(document, diagnostic.span, diagnostic.message));
    }
    for (const Note& note : diagnostic.notes) {
        if (note.span) notes.push_back(related(document, *note.span, note.message));
        if (!note.span || notes.back().is_null()) message += "\n" + note.message;
    }
    std::erase_if(notes.get_ref<Json::array_t&>(), [](const Json& note) { return note.is_null(); });
    const bool is_error = diagnostic.severity == Severity::error;
    Json json = {{"range", range_of(document, own_span(script, diagnostic.span))},
                 {"severity", is_error ? severity_error : severity_warning},
                 {"source", "cascade"},
                 {"message", std::move(message)}};
    if (!notes.empty()) json["relatedInformation"] = std::move(notes);
    return json;
}

Json remark(const Document& document, Span span, int severity, const std::string& message) {
    return {{"range", range_of(document, span)},
            {"severity", severity},
            {"source", "cascade"},
            {"message", message}};
}

/// The warnings of `cascade check` about stages from which no pattern can grow.
void add_outlooks(Json& list, const Document& document, const Script& script) {
    for (std::uint32_t k = 0; k < script.program->stages.size(); ++k) {
        const std::string message = outlook(*script.program, k);
        if (message.empty()) continue;
        list.push_back(remark(document, own_span(script, script.program->stages[k].span),
                              severity_warning, message));
    }
}

}  // namespace

Json diagnostics_of(Document& document) {
    Json list = Json::array();
    const Script& script = document.script();
    std::size_t left = 0;
    for (const Diagnostic& diagnostic : script.diagnostics.sorted()) {
        if (list.size() == most_diagnostics) ++left;
        else list.push_back(json_of(document, diagnostic));
    }
    if (left > 0) {
        list.push_back(remark(document, {}, severity_information,
                              fmt::format("{} not shown", counted(left, "more message"))));
    }
    if (script.program) add_outlooks(list, document, script);
    return list;
}

Result<Json> code_actions(const Asked& asked) {
    Document& document = asked.document;
    const auto range = bytes_of_range(document, member(asked.params, "range"));
    if (!range) return failure("the range of code actions is missing");
    Json actions = Json::array();
    const Script& script = document.script();
    if (document.text().size() > largest_fixed_text) return actions;
    const auto check = [&](const std::string& text) {
        return load_script(script.name, text, script.folder, script.overrides).diagnostics;
    };
    std::size_t tried = 0;
    for (const Diagnostic& diagnostic : script.diagnostics.sorted()) {
        const Span span = diagnostic.span;
        const bool is_here =
            span.source == own_source && span.begin <= range->second && range->first <= span.end;
        if (!is_here || diagnostic.hint.empty()) continue;
        if (tried++ == most_fixes) break;
        const auto fix = fix_of(diagnostic, script.text, script.diagnostics, check);
        if (!fix) continue;
        const Json edit = {{"range", range_of(document, span)}, {"newText", *fix}};
        actions.push_back({{"title", fmt::format("Write '{}'", *fix)},
                           {"kind", "quickfix"},
                           {"isPreferred", true},
                           {"diagnostics", {json_of(document, diagnostic)}},
                           {"edit", {{"changes", {{document.uri(), {edit}}}}}}});
    }
    return actions;
}

}  // namespace cascade::lsp
