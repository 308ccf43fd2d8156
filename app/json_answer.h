// The answer of a command with --json. It is one JSON object with all output, whether the command
// succeeds or fails.
#pragma once

#include "core/result.h"
#include "run/script/script.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace cascade {

class JsonAnswer {
public:
    explicit JsonAnswer(std::string_view command) : command_(command) {}

    /// Adds a message without a position in a script.
    void add(std::string_view severity, std::string_view message, std::string_view hint = "");
    /// Adds the diagnostics of a script, with their positions.
    void add(const Script& script);
    /// Adds a part of the text that would be printed without --json.
    void print(std::string_view text) { text_ += text; }
    /// A result of the command, which becomes a member of the JSON object.
    nlohmann::ordered_json& operator[](const std::string& member) { return results_[member]; }

    /// Returns the whole answer as text.
    std::string text(int status) const;

private:
    std::string command_, text_;
    nlohmann::ordered_json messages_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json results_ = nlohmann::ordered_json::object();
};

}  // namespace cascade
