// Messages of editors: the order of a session, and messages that are wrong.
#include "tests/unit/lsp/editor.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace cascade::lsp::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int parse_error = -32700, invalid_request = -32600, method_not_found = -32601,
              invalid_params = -32602, not_initialized = -32002;

int code_of(const std::vector<std::string>& messages) {
    if (messages.size() != 1) return 0;
    const Json message = Json::parse(messages[0]);
    return message.contains("error") ? message["error"]["code"].get<int>() : 0;
}

TEST(LanguageServer, ASession) {
    LanguageServer server;
    EXPECT_EQ(code_of(server.receive(R"({"id":1,"method":"textDocument/hover"})")),
              not_initialized);
    EXPECT_EQ(code_of(server.receive(R"({"id":2,"method":"initialize","params":{}})")), 0);
    EXPECT_EQ(code_of(server.receive(R"({"id":3,"method":"initialize","params":{}})")),
              invalid_request);
    EXPECT_FALSE(server.is_shut_down());
    EXPECT_EQ(code_of(server.receive(R"({"id":"x","method":"shutdown"})")), 0);
    EXPECT_EQ(code_of(server.receive(R"({"id":5,"method":"textDocument/hover"})")),
              invalid_request);
    EXPECT_TRUE(server.is_shut_down());
    EXPECT_FALSE(server.has_ended());
    EXPECT_THAT(server.receive(R"({"method":"exit"})"), IsEmpty());
    EXPECT_TRUE(server.has_ended());
}

TEST(LanguageServer, WrongMessages) {
    Editor editor;
    LanguageServer& server = editor.server();
    for (const char* text : {"", "{", "nonsense", "{\"id\":1", "[1,2", "\xff\xfe", "\"\\ud800\""})
        EXPECT_EQ(code_of(server.receive(text)), parse_error) << text;
    for (const char* text : {"1", "[]", "{}", "{\"id\":1}", "{\"method\":3,\"id\":1}", "null",
                             R"({"id":{},"method":"shutdown"})", R"({"id":1.5,"method":"x"})"})
        EXPECT_EQ(code_of(server.receive(text)), invalid_request) << text;
    EXPECT_EQ(code_of(server.receive(std::string(100'000, '['))), parse_error);
    EXPECT_THAT(server.receive(R"({"id":4,"result":null})"), IsEmpty());
    EXPECT_EQ(code_of(server.receive(R"({"id":1,"method":"workspace/symbol"})")), method_not_found);
    EXPECT_THAT(server.receive(R"({"method":"$/whatever"})"), IsEmpty());
}

TEST(LanguageServer, RequestsWithoutDocumentOrPosition) {
    Editor editor;
    const auto code = [&](const Json& params) {
        const Json answer = editor.answer("textDocument/hover", params);
        return answer.contains("error") ? answer["error"]["code"].get<int>() : 0;
    };
    EXPECT_EQ(code(nullptr), invalid_params);
    EXPECT_EQ(code(Json::array()), invalid_params);
    EXPECT_EQ(code({{"textDocument", {{"uri", "file:///no"}}}}), invalid_params);
    editor.open("stage one: turing_spots { }");
    const Json document = {{"uri", editor.uri()}};
    EXPECT_EQ(code({{"textDocument", document}}), invalid_params);
    EXPECT_EQ(code({{"textDocument", document}, {"position", {{"line", -1}, {"character", 0}}}}),
              invalid_params);
    EXPECT_EQ(code({{"textDocument", document}, {"position", {{"line", 1e9}, {"character", 0}}}}),
              invalid_params);
    EXPECT_EQ(code({{"textDocument", document},
                    {"position", {{"line", 4000000000u}, {"character", 0}}}}),
              0);
}

TEST(LanguageServer, ChangesOfTexts) {
    Editor editor;
    editor.open("# 🐆\nstage one: turing_spts { }\n");
    const Json wrong = editor.diagnostics();
    ASSERT_THAT(wrong, SizeIs(1));
    EXPECT_EQ(text_of(wrong[0]["range"]), "1:11-1:22");
    EXPECT_THAT(wrong[0]["message"].get<std::string>(), HasSubstr("did you mean 'turing_spots'?"));
    EXPECT_EQ(editor.diagnostics(), nullptr) << "nothing has changed";
    editor.type(1, 20, 20, "o");
    EXPECT_THAT(editor.diagnostics(), IsEmpty());
    editor.type(0, 2, 4, "k");  // The leopard has two UTF-16 units.
    editor.type(0, 0, 3, "");
    EXPECT_THAT(editor.diagnostics(), IsEmpty());
    const auto said = editor.tell("textDocument/didChange",
                                  {{"textDocument", {{"uri", editor.uri()}}},
                                   {"contentChanges", {{{"range", 3}, {"text", "x"}}}}});
    ASSERT_THAT(said, SizeIs(2));
    EXPECT_EQ(said[0]["method"], "window/logMessage");
    EXPECT_THAT(said[1]["params"]["diagnostics"], IsEmpty());
    EXPECT_EQ(editor.answer("textDocument/hover",
                            {{"textDocument", {{"uri", editor.uri()}}}})["error"]["code"],
              invalid_params);
}

TEST(LanguageServer, ColumnsInUtf8) {
    const Json capabilities = {{"general", {{"positionEncodings", {"utf-8", "utf-16"}}}}};
    Editor editor(capabilities);
    editor.open("stage μ: nobody { }");
    const Json diagnostics = editor.diagnostics();
    ASSERT_FALSE(diagnostics.empty());
    EXPECT_EQ(text_of(diagnostics[0]["range"]), "0:10-0:16");
}

/// A file that a script uses is read from the editor while it is open, and else from the disk,
/// relative to the script.
TEST(LanguageServer, UsedFiles) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "lsp files";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "mine.cascade") << "system mine { u: 1; u' = -u }\n";
    const std::string uri = "file://" + testing::TempDir() + "/lsp%20files/";
    Editor editor;
    editor.open("system mine { v: 1; v' = 0 }", uri + "mine.cascade");
    editor.open("use \"mine.cascade\"\nstage one: mine { u: 2 }\n", uri + "s.cascade");
    EXPECT_THAT(editor.server().publish(), SizeIs(2));
    editor.tell("textDocument/didClose", {{"textDocument", {{"uri", uri + "mine.cascade"}}}});
    EXPECT_THAT(editor.diagnostics(), IsEmpty()) << "from the disk";
    const Json at = editor.at("definition", 1, 12);
    EXPECT_EQ(text_of(at["range"]), "0:7-0:11");
    EXPECT_THAT(at["uri"].get<std::string>(), testing::EndsWith("lsp%20files/mine.cascade"));
    EXPECT_EQ(editor.about("documentLink")[0]["target"], at["uri"]);
    editor.open("system mine { v: 1; v' = w }", uri + "mine.cascade");
    editor.open("use \"mine.cascade\"\nstage one: mine { }\n", uri + "s.cascade");
    const auto sent = Editor::parsed(editor.server().publish());
    ASSERT_THAT(sent, SizeIs(2));
    const Json& diagnostics = sent[1]["params"]["diagnostics"];
    ASSERT_THAT(diagnostics, SizeIs(1));
    EXPECT_EQ(text_of(diagnostics[0]["range"]), "0:4-0:18");
    EXPECT_THAT(diagnostics[0]["message"].get<std::string>(), HasSubstr("mine.cascade:1:26: "));
    std::filesystem::remove_all(folder);
}

TEST(LanguageServer, ManyDocuments) {
    Editor editor;
    for (std::size_t k = 0; k < most_documents; ++k)
        editor.open("", "file:///s" + std::to_string(k));
    const auto said =
        editor.tell("textDocument/didOpen",
                    {{"textDocument", {{"uri", "file:///more"}, {"version", 1}, {"text", ""}}}});
    ASSERT_THAT(said, SizeIs(1));
    EXPECT_EQ(said[0]["method"], "window/logMessage");
}

/// Valid messages with random parts replaced. The server answers each request once.
TEST(LanguageServer, RandomMessages) {
    const char* const seed_text = std::getenv("CASCADE_TEST_SEED");
    const auto seed = seed_text ? static_cast<unsigned>(std::strtoul(seed_text, nullptr, 10))
                                : std::random_device()();
    SCOPED_TRACE("CASCADE_TEST_SEED=" + std::to_string(seed));
    std::mt19937 random(seed);
    const std::vector<std::string> methods{
        "hover",         "completion",    "definition",          "references",
        "prepareRename", "rename",        "formatting",          "documentSymbol",
        "foldingRange",  "documentColor", "semanticTokens/full", "colorPresentation",
        "codeAction",    "didChange",     "documentHighlight",   "documentLink"};
    const std::string pieces[] = {"{", "}", "\n", "u' = ", "🐆", "\"", "rgb(1, 0, 0)", "stage ",
                                  "β", ":", "\r", "#x",    "a", "(",  "one",          "system "};
    Editor editor;
    editor.open("system s { u: 1; k: 2; u' = -k * u }\nstage one: s { iterations: 4 }\n");
    for (int trial = 0; trial < 400; ++trial) {
        const auto number = [&] { return random() % 8 == 0 ? random() : random() % 40; };
        const auto position = [&] { return Json{{"line", number() % 5}, {"character", number()}}; };
        const Json range = {{"start", position()}, {"end", position()}};
        const std::string text = pieces[random() % std::size(pieces)];
        Json params = {{"textDocument", {{"uri", editor.uri()}}},
                       {"position", position()},
                       {"range", range},
                       {"newName", text},
                       {"color", {{"red", 2}, {"green", -1}, {"blue", 0.5}}},
                       {"contentChanges", {{{"range", range}, {"text", text}}}}};
        if (random() % 10 == 0) params[random() % 2 == 0 ? "position" : "range"] = trial;
        const std::string method = "textDocument/" + methods[random() % methods.size()];
        if (method == "textDocument/didChange") {
            if (params["range"].is_object()) editor.tell(method, params);
        } else {
            const Json answer = editor.answer(method, params);
            EXPECT_NE(answer.contains("result"), answer.contains("error")) << answer;
        }
        if (trial % 20 == 0) {
            editor.type(0, 0, 0, "");
            EXPECT_TRUE(editor.diagnostics().is_array());
        }
    }
}

}  // namespace
}  // namespace cascade::lsp::test
