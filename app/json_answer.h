// The answer of a command with --json: one object for all of its output, also if it fails.
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

    /// A message without a place.
    void add(std::string_view severity, std::string_view message, std::string_view hint = "");
    /// The diagnostics of a script, with their places.
    void add(const Script& script);
    /// A part of what is printed without --json.
    void print(std::string_view text) { text_ += text; }
    /// The result of the command: a member of the answer.
    nlohmann::ordered_json& operator[](const std::string& member) { return results_[member]; }

    /// The whole answer.
    std::string text(int status) const;

private:
    std::string command_, text_;
    nlohmann::ordered_json messages_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json results_ = nlohmann::ordered_json::object();
};

}  // namespace cascade
