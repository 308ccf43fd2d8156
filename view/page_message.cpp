// The table of requests, and functions that read their fields.
#include "view/page_message.h"

#include "core/base64.h"
#include "core/json_size.h"
#include "core/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace cascade {
namespace {

using Json = nlohmann::json;

/// A page's numbers are binary64, so larger integers may be inexact.
constexpr std::int64_t most_steps = std::int64_t{1} << 53;
constexpr std::int64_t largest_scale = 64;
constexpr std::int64_t most_stages = 1'000'000;

/// Reads the fields of a message. fault() describes the first field that is wrong.
class FieldReader {
public:
    explicit FieldReader(const Json& object) : object_(object) {}

    std::string text(const char* name) {
        const Json* const field = find(name);
        if (field != nullptr && field->is_string()) return field->get<std::string>();
        complain(name, "a text");
        return {};
    }

    /// Reads a text in base64 and returns its bytes.
    std::string bytes(const char* name) {
        auto bytes = from_base64(text(name));
        if (!bytes) complain(name, "bytes in base64");
        return std::move(bytes).value_or("");
    }

    std::int64_t whole(const char* name, std::int64_t low, std::int64_t high) {
        const Json* const field = find(name);
        if (field != nullptr && field->is_number_integer()) {
            // JSON numbers above the largest signed integer are stored as unsigned.
            const bool is_large = field->is_number_unsigned() &&
                                  field->get<std::uint64_t>() > static_cast<std::uint64_t>(high);
            const auto number = is_large ? high + 1 : field->get<std::int64_t>();
            if (low <= number && number <= high) return number;
        }
        complain(name, fmt::format("a whole number from {} to {}", low, high));
        return low;
    }

    /// Reads a number from 0 to 1.
    double part(const char* name) {
        const Json* const field = find(name);
        if (field != nullptr && field->is_number()) {
            const auto number = field->get<double>();
            if (0 <= number && number <= 1) return number;
        }
        complain(name, "a number from 0 to 1");
        return 0;
    }

    bool has(const char* name) const { return find(name) != nullptr; }

    float number(const char* name) {
        const Json* const field = find(name);
        if (field != nullptr && field->is_number()) {
            const auto number = field->get<double>();
            if (std::abs(number) <= std::numeric_limits<float>::max()) {
                return static_cast<float>(number);
            }
        }
        complain(name, "a number");
        return 0;
    }

    /// Reads a pair of different numbers. The second may be smaller than the first.
    ValueRange range(const char* from, const char* to) {
        const ValueRange range{number(from), number(to)};
        if (range.low == range.high) complain(to, fmt::format("another number than '{}'", from));
        return range;
    }

    Axis axis(const char* name) {
        const auto axis = axis_of_name(text(name));
        if (!axis) complain(name, "x, y or z");
        return axis.value_or(Axis::z);
    }

    /// Reads a flag. A missing flag is false.
    bool flag(const char* name) {
        const Json* const field = find(name);
        if (field == nullptr) return false;
        if (!field->is_boolean()) complain(name, "true or false");
        return field->is_boolean() && field->get<bool>();
    }

    const std::string& fault() const { return fault_; }

private:
    const Json* find(const char* name) const {
        const auto found = object_.find(name);
        return found == object_.end() ? nullptr : &*found;
    }
    void complain(const char* name, std::string_view wanted) {
        if (fault_.empty()) fault_ = fmt::format("'{}' must be {}", name, wanted);
    }

    const Json& object_;
    std::string fault_;
};

struct Verb {
    std::string_view name;
    PageRequest (*read)(FieldReader&);
};

PictureRequest picture(FieldReader& fields) {
    PictureRequest request;
    request.show = fields.text("show");
    request.palette = fields.text("palette");
    request.scale = static_cast<int>(fields.whole("scale", 1, largest_scale));
    if (fields.has("low")) request.range = fields.range("low", "high");
    if (fields.has("axis")) request.slice = {fields.axis("axis"), fields.part("place")};
    if (fields.has("around")) {
        request.view.azimuth = static_cast<float>(fields.whole("around", -180, 180));
        request.view.elevation = static_cast<float>(fields.whole("above", -89, 89));
    }
    request.flat = fields.flag("flat");
    return request;
}

std::size_t byte_of(FieldReader& fields) {
    return static_cast<std::size_t>(fields.whole("byte", 0, largest_page_message));
}

PageRequest change(Change made, FieldReader& fields) {
    return SessionCommand(MakeChange{std::move(made), fields.flag("joins_last")});
}

constexpr std::array<Verb, 29> verbs{{
    {"text", [](FieldReader& fields) { return change(SetText{fields.text("text")}, fields); }},
    {"set",
     [](FieldReader& fields) {
         auto name = fields.text("name");
         return change(SetNumber{std::move(name), fields.text("expression")}, fields);
     }},
    {"paint",
     [](FieldReader& fields) {
         auto item = fields.text("item");
         return change(Paint{std::move(item), fields.text("expression")}, fields);
     }},
    {"next_stage", [](FieldReader& fields) { return change(NextStage{}, fields); }},
    {"go_to_stage",
     [](FieldReader& fields) -> PageRequest {
         return SessionCommand(
             GoToStage{static_cast<std::uint32_t>(fields.whole("stage", 1, most_stages) - 1)});
     }},
    {"restart", [](FieldReader&) -> PageRequest { return SessionCommand(GoToStage{0}); }},
    {"undo", [](FieldReader&) -> PageRequest { return SessionCommand(Undo{}); }},
    {"redo", [](FieldReader&) -> PageRequest { return SessionCommand(Redo{}); }},
    {"run", [](FieldReader&) -> PageRequest { return SessionCommand(GoOn{}); }},
    {"pause", [](FieldReader&) -> PageRequest { return SessionCommand(Pause{}); }},
    {"step",
     [](FieldReader& fields) -> PageRequest {
         return SessionCommand(TakeSteps{fields.whole("count", 1, most_steps)});
     }},
    {"show",
     [](FieldReader& fields) -> PageRequest {
         return SessionCommand(Show{fields.text("expression")});
     }},
    {"slice",
     [](FieldReader& fields) -> PageRequest {
         const Axis axis = fields.axis("axis");
         return SessionCommand(ShowSlice{{axis, fields.part("place")}});
     }},
    {"page", [](FieldReader& fields) -> PageRequest { return NamePage{fields.text("name")}; }},
    {"next_snapshot", [](FieldReader&) -> PageRequest { return NextSnapshot{}; }},
    {"log", [](FieldReader&) -> PageRequest { return PageQuestion(AskForLog{}); }},
    {"names",
     [](FieldReader& fields) -> PageRequest {
         return PageQuestion(AskForNames{fields.text("text")});
     }},
    {"explain",
     [](FieldReader& fields) -> PageRequest {
         return PageQuestion(AskAboutName{fields.text("text")});
     }},
    {"fixes",
     [](FieldReader& fields) -> PageRequest {
         return PageQuestion(AskForFixes{fields.text("text")});
     }},
    {"values",
     [](FieldReader& fields) -> PageRequest {
         return PageQuestion(AskForValues{fields.whole("cell", -1, most_steps)});
     }},
    {"picture",
     [](FieldReader& fields) -> PageRequest {
         return PageQuestion(AskForPicture{picture(fields)});
     }},
    {"model",
     [](FieldReader& fields) -> PageRequest {
         return SaveModel{picture(fields), ModelForm::model};
     }},
    {"maps",
     [](FieldReader& fields) -> PageRequest {
         return SaveModel{picture(fields), ModelForm::maps};
     }},
    {"uses",
     [](FieldReader& fields) -> PageRequest {
         auto text = fields.text("text");
         return PageQuestion(AskForUses{std::move(text), byte_of(fields)});
     }},
    {"rename",
     [](FieldReader& fields) -> PageRequest {
         auto text = fields.text("text");
         const std::size_t byte = byte_of(fields);
         return PageQuestion(AskToRename{std::move(text), byte, fields.text("name")});
     }},
    {"measure",
     [](FieldReader& fields) -> PageRequest {
         auto x = fields.text("x");
         return PageQuestion(AskForMeasures{std::move(x), fields.text("y")});
     }},
    {"features",
     [](FieldReader& fields) -> PageRequest {
         return PageQuestion(AskForFeatures{fields.text("show")});
     }},
    {"load",
     [](FieldReader& fields) -> PageRequest {
         LoadPart part;
         part.name = fields.text("name");
         part.at = static_cast<std::uint64_t>(fields.whole("at", 0, most_steps));
         part.size = static_cast<std::uint64_t>(fields.whole("size", 0, most_steps));
         part.bytes = fields.bytes("bytes");
         return part;
     }},
    {"surface", [](FieldReader&) -> PageRequest { return AskForSurface{}; }},
}};

}  // namespace

std::string text_of(const SessionCommand& command) {
    const auto* const made = std::get_if<MakeChange>(&command);
    const auto* const set = made != nullptr ? std::get_if<SetText>(&made->change) : nullptr;
    return set != nullptr ? set->text : std::string();
}

Result<PageMessage> parse_page_message(std::string_view text) {
    if (text.size() > largest_page_message) return failure("the message is too long");
    const JsonSize size = measure_json(text);
    if (size.depth > 1 || size.values > 16) {
        return failure("the message must be a flat JSON object of at most 16 values");
    }
    const Json object = Json::parse(text, nullptr, false);
    if (!object.is_object()) return failure("the message is not a JSON object");
    FieldReader fields(object);
    PageMessage message;
    if (object.contains("id")) {
        message.id = static_cast<std::uint64_t>(fields.whole("id", 0, most_steps));
    }
    const std::string name = fields.text("do");
    if (!fields.fault().empty()) return failure(fields.fault());
    for (const Verb& verb : verbs) {
        if (verb.name != name) continue;
        message.request = verb.read(fields);
        if (!fields.fault().empty()) return failure(fields.fault());
        return message;
    }
    return failure(fmt::format("there is no request '{}'", short_name(name)));
}

}  // namespace cascade
