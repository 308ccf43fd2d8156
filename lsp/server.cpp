// Reads messages, finds the document that they are about, and calls the functions of answers.h.
#include "lsp/server.h"

#include "core/json_size.h"
#include "core/printable.h"
#include "core/version.h"
#include "lang/syntax/parse.h"
#include "lsp/answers.h"
#include "lsp/frames.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::lsp {
namespace {

// Error codes of JSON-RPC 2.0 and of the protocol.
constexpr int parse_error = -32700, invalid_request = -32600, method_not_found = -32601,
              invalid_params = -32602, not_initialized = -32002, request_failed = -32803;
constexpr int type_warning = 2;  ///< MessageType

std::string print(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json error(const Json& id, int code, const std::string& message) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}};
}

Json notification(const char* method, Json params) {
    return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}};
}

bool is_id(const Json& id) { return id.is_string() || id.is_number_integer(); }

/// Whether a text is small enough to be parsed as JSON. For a text of brackets, a parser needs
/// memory of many times the text's size.
bool is_parsable(std::string_view text) {
    const JsonSize size = measure_json(text);
    return size.depth <= 64 && size.values <= 2'000'000;
}

Json capabilities(ColumnUnit unit) {
    return {{"positionEncoding", unit == ColumnUnit::utf8 ? "utf-8" : "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", 2}}},
            {"hoverProvider", true},
            {"completionProvider", {{"triggerCharacters", {".", ":", "\""}}}},
            {"definitionProvider", true},
            {"referencesProvider", true},
            {"documentHighlightProvider", true},
            {"renameProvider", {{"prepareProvider", true}}},
            {"documentFormattingProvider", true},
            {"documentSymbolProvider", true},
            {"foldingRangeProvider", true},
            {"semanticTokensProvider", {{"legend", semantic_legend()}, {"full", true}}},
            {"colorProvider", true},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
            {"documentLinkProvider", Json::object()}};
}

}  // namespace

std::vector<std::string> LanguageServer::receive(std::string_view text) {
    to_send_.clear();
    const Json message = is_parsable(text) ? Json::parse(text, nullptr, false) : Json();
    if (message.is_discarded() || !is_parsable(text)) {
        return {print(error(nullptr, parse_error, "the message is not JSON, or it is too deep"))};
    }
    const Json& method = member(message, "method");
    const Json& id = member(message, "id");
    const bool is_request = message.is_object() && message.contains("id");
    if (!method.is_string()) {
        // A message without a method answers a request of the server, but this server sends no
        // requests.
        if (is_request && (message.contains("result") || message.contains("error"))) return {};
        return {print(error(nullptr, invalid_request, "the message has no method"))};
    }
    const auto name = method.get<std::string>();
    const Json& params = member(message, "params");
    if (is_request && !is_id(id)) {
        to_send_.push_back(
            print(error(nullptr, invalid_request, "an id is a text or a whole number")));
    } else if (is_request) {
        to_send_.push_back(print(answer(id, name, params)));
    } else {
        take_note(name, params);
    }
    return std::move(to_send_);
}

std::string LanguageServer::refuse_large_message() {
    return print(error(nullptr, invalid_request,
                       fmt::format("a message has at most {} bytes; this one was ignored",
                                   largest_message)));
}

Json LanguageServer::answer(const Json& id, const std::string& method, const Json& params) {
    const auto result = [&](Json value) {
        return Json{{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(value)}};
    };
    if (is_shut_down_) return error(id, invalid_request, "the server has been shut down");
    if (method == "initialize") {
        if (is_initialized_) return error(id, invalid_request, "the server is initialized already");
        return result(initialize(params));
    }
    if (!is_initialized_) return error(id, not_initialized, "the server is not initialized");
    if (method == "shutdown") {
        is_shut_down_ = true;
        return result(nullptr);
    }
    const auto row = std::ranges::find(answers(), method, &Answer::request);
    if (row == answers().end()) {
        return error(id, method_not_found, fmt::format("no method '{}'", short_name(method)));
    }
    Document* const document = find(params);
    if (document == nullptr) return error(id, invalid_params, "the document is not open");
    Asked asked{*document, params};
    if (row->has_position) {
        const auto position = position_from(member(params, "position"));
        if (!position) return error(id, invalid_params, "the position is missing");
        asked.byte = document->lines().byte_at(document->text(), *position);
    }
    auto answer = row->answer(asked);
    if (answer) return result(*std::move(answer));
    const Failure& failure = answer.error();
    return error(id, request_failed,
                 failure.hint.empty() ? failure.message
                                      : fmt::format("{} ({})", failure.message, failure.hint));
}

Json LanguageServer::initialize(const Json& params) {
    is_initialized_ = true;
    const Json& units =
        member(member(member(params, "capabilities"), "general"), "positionEncodings");
    const bool has_utf8 = units.is_array() && std::ranges::count(units, Json("utf-8")) > 0;
    unit_ = has_utf8 ? ColumnUnit::utf8 : ColumnUnit::utf16;
    return {{"capabilities", capabilities(unit_)},
            {"serverInfo", {{"name", "cascade"}, {"version", std::string(version())}}}};
}

void LanguageServer::take_note(const std::string& method, const Json& params) {
    if (method == "exit") has_ended_ = true;
    if (!is_initialized_ || is_shut_down_) return;
    if (method == "textDocument/didOpen") open(params);
    if (method == "textDocument/didChange") change(params);
    if (method == "textDocument/didClose") close(params);
}

void LanguageServer::open(const Json& params) {
    const Json& opened = member(params, "textDocument");
    const std::string uri = text_of_member(opened, "uri");
    const bool is_new = !documents_.contains(uri);
    if (uri.empty() || !member(opened, "text").is_string())
        return log("a document without address or text was not opened");
    if (is_new && documents_.size() >= most_documents)
        return log(fmt::format("more than {} documents are open", most_documents));
    auto document = std::make_unique<Document>(uri, text_of_member(opened, "text"), unit_,
                                               [this, uri] { return files_besides(uri); });
    const Json& version = member(opened, "version");
    if (version.is_number_integer()) document->version = version.get<std::int64_t>();
    documents_.insert_or_assign(uri, std::move(document));
    forget_users_of_files();
}

void LanguageServer::change(const Json& params) {
    Document* const document = find(params);
    const Json& changes = member(params, "contentChanges");
    if (document == nullptr) return log("a document that is not open was changed");
    const auto refuse = [&] {
        log(fmt::format("a change of {} could not be read; open it again", document->uri()));
        close(params);
    };
    if (!changes.is_array()) return refuse();
    for (const Json& change : changes) {
        if (!member(change, "text").is_string()) return refuse();
        const Json& range = member(change, "range");
        if (range.is_null()) {
            document->set_text(text_of_member(change, "text"));
            continue;
        }
        const auto from = position_from(member(range, "start")),
                   to = position_from(member(range, "end"));
        if (!from || !to) return refuse();
        document->replace(*from, *to, text_of_member(change, "text"));
    }
    const Json& version = member(member(params, "textDocument"), "version");
    if (version.is_number_integer()) document->version = version.get<std::int64_t>();
    forget_users_of_files();
}

/// Closes a document, and removes its diagnostics from the editor.
void LanguageServer::close(const Json& params) {
    const Document* const document = find(params);
    if (document == nullptr) return;
    const std::string uri = document->uri();
    to_send_.push_back(print(notification("textDocument/publishDiagnostics",
                                          {{"uri", uri}, {"diagnostics", Json::array()}})));
    documents_.erase(uri);
    forget_users_of_files();
}

Document* LanguageServer::find(const Json& params) {
    const auto found = documents_.find(text_of_member(member(params, "textDocument"), "uri"));
    return found == documents_.end() ? nullptr : found->second.get();
}

/// Marks all documents that use files to be checked again, because a used file may be open and may
/// have changed.
void LanguageServer::forget_users_of_files() {
    for (const auto& [uri, document] : documents_) {
        if (!document->is_changed && !document->script().tree.uses.empty()) document->forget();
    }
}

std::vector<std::pair<std::filesystem::path, std::string>> LanguageServer::files_besides(
    const std::string& uri) const {
    std::vector<std::pair<std::filesystem::path, std::string>> files;
    for (const auto& [other, document] : documents_) {
        if (other != uri && document->path())
            files.emplace_back(*document->path(), document->text());
    }
    return files;
}

void LanguageServer::log(const std::string& message) {
    to_send_.push_back(
        print(notification("window/logMessage", {{"type", type_warning}, {"message", message}})));
}

std::vector<std::string> LanguageServer::publish() {
    std::vector<std::string> messages;
    for (const auto& [uri, document] : documents_) {
        if (!document->is_changed) continue;
        document->is_changed = false;
        Json params = {{"uri", uri}, {"diagnostics", diagnostics_of(*document)}};
        if (document->version) params["version"] = *document->version;
        messages.push_back(
            print(notification("textDocument/publishDiagnostics", std::move(params))));
    }
    return messages;
}

}  // namespace cascade::lsp
