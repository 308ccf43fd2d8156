// Positions are given as lines and columns, counted from 1, as in messages.
#include "app/json_answer.h"

#include "core/version.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

using Json = nlohmann::ordered_json;

/// Adds a position in a script to a message, as JSON members.
void add_place(Json& message, const Sources& sources, Span span) {
    const Source& source = sources[span.source];
    const Location begin = source.locate(span.begin), end = source.locate(span.end);
    message["file"] = source.name();
    message["line"] = begin.line;
    message["column"] = begin.column;
    message["end_line"] = end.line;
    message["end_column"] = end.column;
}

}  // namespace

void JsonAnswer::add(std::string_view severity, std::string_view message, std::string_view hint) {
    Json all = {{"severity", severity}, {"message", message}};
    if (!hint.empty()) all["hint"] = hint;
    messages_.push_back(std::move(all));
}

void JsonAnswer::add(const Script& script) {
    for (const Diagnostic& each : script.diagnostics.sorted()) {
        add(each.severity == Severity::error ? "error" : "warning", each.message, each.hint);
        Json& message = messages_.back();
        add_place(message, script.sources, each.span);
        for (const Note& note : each.notes) {
            Json of_note = {{"message", note.message}};
            if (note.span) add_place(of_note, script.sources, *note.span);
            message["notes"].push_back(std::move(of_note));
        }
    }
}

std::string JsonAnswer::text(int status) const {
    Json all = {{"cascade", version()}, {"command", command_}, {"status", status}};
    all.update(results_);
    all["messages"] = messages_;
    all["text"] = text_;
    // File names may contain bytes that are not UTF-8.
    return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cascade
