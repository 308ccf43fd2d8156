// A server of the Language Server Protocol 3.17, as a function from messages to messages.
#pragma once

#include "lsp/document.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::lsp {

/// The largest number of documents that may be open at a time.
inline constexpr std::size_t most_documents = 1000;

class LanguageServer {
public:
    LanguageServer() = default;
    LanguageServer(const LanguageServer&) = delete;  // Documents refer to the server.
    LanguageServer& operator=(const LanguageServer&) = delete;

    /// Carries out a message of the editor. Returns the messages to send, without headers. If the
    /// text is not a message, the answer is an error.
    std::vector<std::string> receive(std::string_view message);
    /// The answer to a message of more than largest_message bytes, which was not read.
    static std::string refuse_large_message();

    /// The diagnostics of all documents that have changed since the last call, as messages.
    std::vector<std::string> publish();

    /// Whether the editor has sent `exit`.
    bool has_ended() const { return has_ended_; }
    /// Whether the editor has sent `shutdown`, as it should before it ends.
    bool is_shut_down() const { return is_shut_down_; }

private:
    using Json = nlohmann::json;

    /// Answers a request with the request's result or with an error.
    Json answer(const Json& id, const std::string& method, const Json& params);
    Json initialize(const Json& params);
    void take_note(const std::string& method, const Json& params);
    void open(const Json& params);
    void change(const Json& params);
    void close(const Json& params);
    Document* find(const Json& params);
    void forget_users_of_files();
    std::vector<std::pair<std::filesystem::path, std::string>> files_besides(
        const std::string& uri) const;
    void log(const std::string& message);

    std::map<std::string, std::unique_ptr<Document>, std::less<>> documents_;
    std::vector<std::string> to_send_;  ///< Messages that are sent besides the answer.
    ColumnUnit unit_ = ColumnUnit::utf16;
    bool is_initialized_ = false, is_shut_down_ = false, has_ended_ = false;
};

}  // namespace cascade::lsp
