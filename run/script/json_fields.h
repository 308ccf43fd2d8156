// Reads the members of a JSON object without exceptions, which WebAssembly lacks. The JSON may come
// from an untrusted source.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cascade {

/// Sets a value from JSON. Returns false if the JSON has another type or is out of range. The value
/// is then unspecified. Integers must not be negative.
template <typename T>
bool from_json_value(const nlohmann::json& json, T& value) {
    if constexpr (std::is_same_v<T, bool>) {
        if (!json.is_boolean()) return false;
        value = json.get<bool>();
    } else if constexpr (std::is_same_v<T, std::string>) {
        if (!json.is_string()) return false;
        value = json.get<std::string>();
    } else if constexpr (std::is_integral_v<T>) {
        if (!json.is_number_integer() || json < 0 || json > std::numeric_limits<T>::max()) {
            return false;
        }
        value = json.get<T>();
    } else {
        static_assert(std::is_floating_point_v<T>);
        if (!json.is_number()) return false;
        value = json.get<T>();
    }
    return true;
}

template <typename T>
bool from_json_value(const nlohmann::json& json, std::optional<T>& value) {
    return from_json_value(json, value.emplace());
}

template <typename First, typename Second>
bool from_json_value(const nlohmann::json& json, std::pair<First, Second>& both) {
    return json.is_array() && json.size() == 2 && from_json_value(json[0], both.first) &&
           from_json_value(json[1], both.second);
}

template <typename T>
bool from_json_value(const nlohmann::json& json, std::vector<T>& values) {
    if (!json.is_array()) return false;
    values.clear();
    for (const nlohmann::json& each : json) {
        if (!from_json_value(each, values.emplace_back())) return false;
    }
    return true;
}

/// Reads the members of an object. A missing member leaves the corresponding variable unchanged. A
/// single invalid member makes the whole object invalid.
class JsonFields {
public:
    explicit JsonFields(const nlohmann::json& object)
        : object_(object), is_sound_(object.is_object()) {}

    template <typename T>
    void read(const char* name, T& value) {
        const nlohmann::json* const member = is_sound_ ? find(name) : nullptr;
        if (member != nullptr) is_sound_ = from_json_value(*member, value);
    }
    /// Reads a text, and sets the value to what `parse` returns for it. `parse` returns an
    /// optional, which is empty if the text is invalid.
    template <typename T, typename Parse>
    void read(const char* name, std::optional<T>& value, const Parse& parse) {
        std::optional<std::string> text;
        read(name, text);
        if (is_sound_ && text) is_sound_ = (value = parse(*text)).has_value();
    }

    bool is_sound() const { return is_sound_; }

private:
    const nlohmann::json* find(const char* name) const {
        const auto found = object_.find(name);
        return found == object_.end() ? nullptr : &*found;
    }

    const nlohmann::json& object_;
    bool is_sound_;
};

}  // namespace cascade
