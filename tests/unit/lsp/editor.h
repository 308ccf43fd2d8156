// An editor for tests: sends messages to a server and reads its answers.
#pragma once

#include "lsp/server.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::lsp::test {

using Json = nlohmann::json;

class Editor {
public:
    explicit Editor(Json capabilities = Json::object()) {
        ask("initialize", {{"capabilities", std::move(capabilities)}});
        tell("initialized", Json::object());
    }

    /// The answer to a request: an object with the member `result` or `error`.
    Json answer(const std::string& method, Json params) {
        const Json message = {
            {"jsonrpc", "2.0"}, {"id", ++last_id_}, {"method", method}, {"params", params}};
        const std::vector<std::string> sent = server_.receive(message.dump());
        EXPECT_EQ(sent.size(), 1u) << method;
        Json answer = Json::parse(sent.at(0));
        EXPECT_EQ(answer["id"], last_id_);
        return answer;
    }
    Json ask(const std::string& method, Json params) {
        Json answer = this->answer(method, std::move(params));
        EXPECT_FALSE(answer.contains("error")) << answer;
        return answer["result"];
    }
    std::vector<Json> tell(const std::string& method, Json params) {
        const Json message = {{"jsonrpc", "2.0"}, {"method", method}, {"params", params}};
        return parsed(server_.receive(message.dump()));
    }

    void open(const std::string& text, const std::string& uri = "file:///nowhere/s.cascade") {
        uri_ = uri;
        tell("textDocument/didOpen",
             {{"textDocument",
               {{"uri", uri}, {"languageId", "cascade"}, {"version", 1}, {"text", text}}}});
    }
    /// Replaces the part of a line between two columns.
    void type(std::size_t line, std::size_t from, std::size_t to, const std::string& text) {
        const Json range = {{"start", {{"line", line}, {"character", from}}},
                            {"end", {{"line", line}, {"character", to}}}};
        tell("textDocument/didChange", {{"textDocument", {{"uri", uri_}, {"version", 2}}},
                                        {"contentChanges", {{{"range", range}, {"text", text}}}}});
    }
    /// The result of a request about the open document.
    Json about(const std::string& method, Json params = Json::object()) {
        params["textDocument"] = {{"uri", uri_}};
        return ask("textDocument/" + method, std::move(params));
    }
    Json at(const std::string& method, std::size_t line, std::size_t column,
            Json params = Json::object()) {
        params["position"] = {{"line", line}, {"character", column}};
        return about(method, std::move(params));
    }
    /// The published diagnostics of one document.
    Json diagnostics() {
        std::vector<Json> sent = parsed(server_.publish());
        if (sent.empty()) return nullptr;
        return sent.back()["params"]["diagnostics"];
    }

    const std::string& uri() const { return uri_; }
    LanguageServer& server() { return server_; }

    static std::vector<Json> parsed(const std::vector<std::string>& messages) {
        std::vector<Json> result;
        for (const std::string& message : messages) result.push_back(Json::parse(message));
        return result;
    }

private:
    LanguageServer server_;
    std::string uri_;
    int last_id_ = 0;
};

/// "line:column-line:column" of a range.
inline std::string text_of(const Json& range) {
    const auto place = [](const Json& at) {
        return std::to_string(at["line"].get<int>()) + ":" +
               std::to_string(at["character"].get<int>());
    };
    return place(range["start"]) + "-" + place(range["end"]);
}

}  // namespace cascade::lsp::test
