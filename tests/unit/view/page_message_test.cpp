// Messages from pages: each request is parsed, and anything else is refused with a sentence.
#include "view/page_message.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace cascade {
namespace {

template <typename Wanted>
Wanted parse_command(std::string_view text) {
    const auto message = parse_page_message(text);
    EXPECT_TRUE(message.has_value()) << text << ": " << message.error().message;
    if (!message) return {};
    const auto* const command = std::get_if<SessionCommand>(&message->request);
    const auto* const wanted = command != nullptr ? std::get_if<Wanted>(command) : nullptr;
    EXPECT_TRUE(wanted != nullptr) << text;
    return wanted != nullptr ? *wanted : Wanted{};
}

Change parse_change(std::string_view text) { return parse_command<MakeChange>(text).change; }

TEST(PageMessage, Changes) {
    EXPECT_EQ(parse_change(R"({"do": "text", "text": "stage s: turing_spots { }\n"})"),
              Change(SetText{"stage s: turing_spots { }\n"}));
    EXPECT_EQ(parse_change(R"({"do": "set", "name": "ka", "expression": "1/80"})"),
              Change(SetNumber{"ka", "1/80"}));
    EXPECT_EQ(parse_change(R"({"do": "paint", "item": "b", "expression": "mix(b, 8, é) + 1"
})"),
              Change(Paint{"b", "mix(b, 8, é) + 1"}));
    EXPECT_EQ(parse_change(R"({"do": "next_stage"})"), Change(NextStage{}));
    EXPECT_FALSE(parse_command<MakeChange>(R"({"do": "next_stage"})").joins_last);
    EXPECT_TRUE(
        parse_command<MakeChange>(R"({"do": "next_stage", "joins_last": true})").joins_last);
}

TEST(PageMessage, Commands) {
    EXPECT_EQ(parse_command<GoToStage>(R"({"do": "go_to_stage", "stage": 3})").stage, 2U);
    EXPECT_EQ(parse_command<GoToStage>(R"({"do": "restart"})").stage, 0U);
    parse_command<Undo>(R"({"do": "undo"})");
    parse_command<Redo>(R"({"do": "redo"})");
    parse_command<GoOn>(R"({"do": "run"})");
    parse_command<Pause>(R"({"do": "pause"})");
    EXPECT_EQ(parse_command<TakeSteps>(R"({"do": "step", "count": 100})").count, 100);
    EXPECT_EQ(parse_command<Show>(R"({"do": "show", "expression": ""})").expression, "");
    EXPECT_EQ(parse_command<ShowSlice>(R"({"do": "slice", "axis": "x", "place": 0.25})").slice,
              (Slice{Axis::x, 0.25}));
    const auto surface = parse_page_message(R"({"do": "surface"})");
    ASSERT_TRUE(surface.has_value());
    EXPECT_TRUE(std::holds_alternative<AskForSurface>(surface->request));
    const auto next = parse_page_message(R"({"do": "next_snapshot", "id": 7})");
    ASSERT_TRUE(next.has_value());
    EXPECT_EQ(next->id, 7U);
    EXPECT_TRUE(std::holds_alternative<NextSnapshot>(next->request));
    const auto log = parse_page_message(R"({"do": "log"})");
    ASSERT_TRUE(log.has_value());
    EXPECT_TRUE(std::holds_alternative<PageQuestion>(log->request));
}

TEST(PageMessage, NamesOfPages) {
    const auto message = parse_page_message(R"({"do": "page", "name": "a1"})");
    ASSERT_TRUE(message.has_value());
    EXPECT_EQ(std::get<NamePage>(message->request).name, "a1");
}

TEST(PageMessage, Questions) {
    const auto names = parse_page_message(R"({"do": "names", "text": "u' = la"})");
    ASSERT_TRUE(names.has_value());
    EXPECT_EQ(std::get<AskForNames>(std::get<PageQuestion>(names->request)).text, "u' = la");
    const auto about = parse_page_message(R"({"do": "explain", "text": "u"})");
    ASSERT_TRUE(about.has_value());
    EXPECT_EQ(std::get<AskAboutName>(std::get<PageQuestion>(about->request)).text, "u");
    const auto values = parse_page_message(R"({"do": "values", "cell": 7})");
    ASSERT_TRUE(values.has_value());
    EXPECT_EQ(std::get<AskForValues>(std::get<PageQuestion>(values->request)).cell, 7);
    const auto features = parse_page_message(R"({"do": "features", "show": "2 * u"})");
    ASSERT_TRUE(features);
    EXPECT_EQ(std::get<AskForFeatures>(std::get<PageQuestion>(features->request)).show, "2 * u");
    const auto measures = parse_page_message(R"({"do": "measure", "x": "u", "y": "v"})");
    ASSERT_TRUE(measures.has_value());
    EXPECT_EQ(std::get<AskForMeasures>(std::get<PageQuestion>(measures->request)).y, "v");
    const auto picture = parse_page_message(
        R"({"do": "picture", "show": "u", "palette": "grey", "scale": 4, "low": -1, "high": 2.5,)"
        R"( "axis": "y", "place": 0.25})");
    ASSERT_TRUE(picture.has_value());
    const auto turned = parse_page_message(
        R"({"do": "picture", "show": "", "palette": "grey", "scale": 1, "around": -40, "above": 7})");
    ASSERT_TRUE(turned.has_value());
    const View view = std::get<AskForPicture>(std::get<PageQuestion>(turned->request)).request.view;
    EXPECT_EQ(view.azimuth, -40);
    EXPECT_EQ(view.elevation, 7);
    EXPECT_FALSE(parse_page_message(
        R"({"do": "picture", "show": "", "palette": "grey", "scale": 1, "around": 40})"));
    const auto& wanted = std::get<AskForPicture>(std::get<PageQuestion>(picture->request)).request;
    EXPECT_EQ(wanted.scale, 4);
    EXPECT_EQ(wanted.range->high, 2.5F);
    EXPECT_EQ(wanted.slice, (Slice{Axis::y, 0.25}));
    for (const char* range : {R"("low": 1)", R"("low": 1, "high": 1)", R"("low": 1, "high": "")"}) {
        EXPECT_FALSE(parse_page_message(fmt::format(
            R"({{"do": "picture", "show": "", "palette": "grey", "scale": 1, {}}})", range)))
            << range;
    }
    EXPECT_FALSE(
        parse_page_message(R"({"do": "picture", "show": "", "palette": "grey", "scale": 65})"));
}

TEST(PageMessage, NamesInTexts) {
    const auto uses = parse_page_message(R"({"do": "uses", "text": "u: v", "byte": 3})");
    ASSERT_TRUE(uses.has_value());
    EXPECT_EQ(std::get<AskForUses>(std::get<PageQuestion>(uses->request)).byte, 3U);
    const auto rename =
        parse_page_message(R"({"do": "rename", "text": "u: v", "byte": 0, "name": "w"})");
    ASSERT_TRUE(rename.has_value());
    EXPECT_EQ(std::get<AskToRename>(std::get<PageQuestion>(rename->request)).name, "w");
    EXPECT_FALSE(parse_page_message(R"({"do": "uses", "text": "u: v", "byte": -1})"));
}

TEST(PageMessage, ModelsAndMaps) {
    for (const auto& [name, form] :
         {std::pair{"model", ModelForm::model}, {"maps", ModelForm::maps}}) {
        const auto message = parse_page_message(fmt::format(
            R"({{"do": "{}", "show": "u", "palette": "grey", "scale": 1, "flat": true}})", name));
        ASSERT_TRUE(message.has_value());
        EXPECT_EQ(std::get<SaveModel>(message->request).form, form);
        EXPECT_EQ(std::get<SaveModel>(message->request).request.show, "u");
    }
    EXPECT_FALSE(parse_page_message(R"({"do": "model", "show": "u"})"));
}

TEST(PageMessage, SaysWhatIsWrong) {
    const auto fault = [](std::string_view text) {
        const auto message = parse_page_message(text);
        return message ? "nothing" : message.error().message;
    };
    const std::string no_object = "the message is not a JSON object";
    for (const std::string_view text :
         {"", "run", "[]", "3", "{", "{\"do\": \"run\"", "{\"do\": \"run\"} {}", "{'do': 'run'}",
          "{\"do\": \"\xff\"}", "\xef\xbb\xbfnull"}) {
        EXPECT_EQ(fault(text), no_object) << text;
    }
    const std::string not_flat = "the message must be a flat JSON object of at most 16 values";
    EXPECT_EQ(fault(R"({"do": {"do": "run"}})"), not_flat);
    EXPECT_EQ(fault(std::string(100000, '[')), not_flat);
    EXPECT_EQ(fault(std::string(100000, ',')), not_flat);
    EXPECT_EQ(fault(std::string(largest_page_message + 1, ' ')), "the message is too long");
    EXPECT_EQ(fault("{}"), "'do' must be a text");
    EXPECT_EQ(fault(R"({"do": 3})"), "'do' must be a text");
    EXPECT_EQ(fault(R"({"do": "format_disk"})"), "there is no request 'format_disk'");
    EXPECT_EQ(fault(R"({"do": "text"})"), "'text' must be a text");
    EXPECT_EQ(fault(R"({"do": "set", "name": "ka", "expression": 3})"),
              "'expression' must be a text");
    EXPECT_EQ(fault(R"({"do": "undo", "id": -1})"),
              "'id' must be a whole number from 0 to 9007199254740992");
    EXPECT_EQ(fault(R"({"do": "next_stage", "joins_last": 1})"),
              "'joins_last' must be true or false");
    EXPECT_EQ(fault(R"({"do": "slice", "axis": "w", "place": 0})"), "'axis' must be x, y or z");
    EXPECT_EQ(fault(R"({"do": "slice", "axis": "z", "place": 1.5})"),
              "'place' must be a number from 0 to 1");
    const std::string count = "'count' must be a whole number from 1 to 9007199254740992";
    for (const std::string_view number :
         {"0", "-1", "1.5", "1e3", "\"1\"", "null", "true", "9007199254740993",
          "18446744073709551615", "99999999999999999999999", "-9223372036854775808"}) {
        EXPECT_EQ(fault("{\"do\": \"step\", \"count\": " + std::string(number) + "}"), count)
            << number;
    }
    EXPECT_EQ(fault(R"({"do": "go_to_stage", "stage": 0})"),
              "'stage' must be a whole number from 1 to 1000000");
}

TEST(PageMessage, PartsOfModels) {
    const auto message = parse_page_message(
        R"({"do": "load", "id": 4, "name": "a.ply", "at": 3, "size": 9, "bytes": "Zm9v"})");
    ASSERT_TRUE(message) << message.error().message;
    const auto& part = std::get<LoadPart>(message->request);
    EXPECT_EQ(part.name, "a.ply");
    EXPECT_EQ(part.at, 3U);
    EXPECT_EQ(part.size, 9U);
    EXPECT_EQ(part.bytes, "foo");
    const auto wrong =
        parse_page_message(R"({"do": "load", "name": "a.ply", "at": 0, "size": 9, "bytes": "f"})");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message, "'bytes' must be bytes in base64");
}

}  // namespace
}  // namespace cascade
