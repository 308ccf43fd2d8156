// Answers of the language server about one script.
#include "tests/unit/lsp/editor.h"

namespace cascade::lsp::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr const char* waves =
    /* 0*/
    "# Waves that fade.\n"
    /* 1*/
    "# Two of them.\n"
    /* 2*/
    "fn half(a) = a / 2   ## the half\n"
    /* 3*/
    "system waves {\n"
    /* 4*/
    "  u: 1 + x\n"
    /* 5*/
    "  k: 0.5 in 0 .. 1   ## how fast it fades\n"
    /* 6*/
    "  d = half(k) * u\n"
    /* 7*/
    "  u' = lap(u) - d\n"
    /* 8*/
    "}\n"
    /* 9*/
    "stage one: waves { iterations: 5 }\n"
    /*10*/
    "stage two: turing_spots {\n"
    /*11*/
    "  ka: 0.01\n"
    /*12*/
    "}\n"
    /*13*/ "picture { color: rgb(1, 0.5, 51/255) }\n";

class LspAnswers : public testing::Test {
protected:
    void SetUp() override { editor.open(waves); }

    std::string hover(std::size_t line, std::size_t column) {
        const Json card = editor.at("hover", line, column);
        return card.is_null() ? "" : card["contents"]["value"].get<std::string>();
    }
    std::vector<std::string> names(std::size_t line, std::size_t column) {
        std::vector<std::string> list;
        const Json answer = editor.at("completion", line, column);
        for (const Json& item : answer["items"]) list.push_back(item["label"]);
        return list;
    }
    std::vector<std::string> ranges(const Json& places) {
        std::vector<std::string> list;
        for (const Json& place : places) list.push_back(text_of(place["range"]));
        return list;
    }

    Editor editor;
};

TEST_F(LspAnswers, Hover) {
    EXPECT_THAT(hover(5, 2), HasSubstr("**`k`** parameter\n\nhow fast it fades\n\nFrom 0 to 1."));
    EXPECT_THAT(hover(5, 3), HasSubstr("one.k: 0.5"));
    EXPECT_THAT(hover(7, 2), HasSubstr("∂u/∂t = ∇²u − d"));
    EXPECT_THAT(hover(6, 2), HasSubstr("d = half(k) u"));
    EXPECT_THAT(hover(7, 8), HasSubstr("the Laplacian"));
    EXPECT_THAT(hover(6, 7), HasSubstr("the half\n\n```text\nfn half(a) = a / 2"));
    EXPECT_THAT(hover(9, 20), HasSubstr("the number of steps"));
    EXPECT_EQ(hover(0, 4), "") << "in a comment";
    EXPECT_EQ(hover(4, 8), "") << "a sign";
    editor.type(5, 5, 8, "@");
    EXPECT_THAT(hover(7, 2), HasSubstr("∂u/∂t")) << "by the last correct text";
}

TEST_F(LspAnswers, HoverOverStagesPredictsTheirWaves) {
    EXPECT_THAT(hover(10, 7), HasSubstr("A stage of turing\\_spots."));
    EXPECT_THAT(hover(10, 14), HasSubstr("∂a/∂t"));
    EXPECT_THAT(hover(9, 7), Not(HasSubstr("Waves of")));
    editor.open("stage one: brusselator { }\n");
    EXPECT_THAT(hover(0, 7), testing::ContainsRegex("Waves of [0-9.]+ cells grow fastest"));
}

TEST_F(LspAnswers, Completion) {
    EXPECT_THAT(names(7, 9), Contains("half"));
    EXPECT_THAT(names(7, 9), Contains("k"));
    EXPECT_THAT(names(9, 12), Contains("brusselator"));
    EXPECT_THAT(names(9, 12), Not(Contains("half")));
    EXPECT_THAT(names(11, 2), Contains("iterations"));
    EXPECT_THAT(names(0, 5), IsEmpty());
    const Json answer = editor.at("completion", 11, 4);
    for (const Json& item : answer["items"]) {
        EXPECT_EQ(text_of(item["textEdit"]["range"]), "11:2-11:4");
    }
}

TEST_F(LspAnswers, DefinitionAndUses) {
    EXPECT_EQ(text_of(editor.at("definition", 6, 11)["range"]), "5:2-5:3");
    EXPECT_EQ(text_of(editor.at("definition", 6, 6)["range"]), "2:3-2:7");
    EXPECT_EQ(editor.at("definition", 0, 0), nullptr);
    EXPECT_THAT(ranges(editor.at("references", 5, 2)), ElementsAre("5:2-5:3", "6:11-6:12"));
    EXPECT_THAT(ranges(
                    editor.at("references", 5, 2, {{"context", {{"includeDeclaration", false}}}})),
                ElementsAre("6:11-6:12"));
    EXPECT_THAT(ranges(editor.at("documentHighlight", 7, 12)),
                ElementsAre("4:2-4:3", "6:16-6:17", "7:2-7:3", "7:11-7:12"));
}

TEST_F(LspAnswers, DefinitionInTheLibrary) {
    const Json place = editor.at("definition", 10, 12);
    ASSERT_TRUE(place.is_object());
    EXPECT_THAT(place["uri"].get<std::string>(), HasSubstr("/library/turing_spots.cascade"));
}

TEST_F(LspAnswers, Rename) {
    EXPECT_EQ(editor.at("prepareRename", 6, 11)["placeholder"], "k");
    EXPECT_EQ(editor.at("prepareRename", 0, 3), nullptr);
    const Json changes = editor.at("rename", 6, 11, {{"newName", "rate"}})["changes"];
    EXPECT_THAT(ranges(changes[editor.uri()]), ElementsAre("5:2-5:3", "6:11-6:12"));
    EXPECT_EQ(changes[editor.uri()][1]["newText"], "rate");
    const Json refused =
        editor.answer("textDocument/rename", {{"textDocument", {{"uri", editor.uri()}}},
                                              {"position", {{"line", 6}, {"character", 11}}},
                                              {"newName", "u"}});
    EXPECT_THAT(refused["error"]["message"].get<std::string>(),
                HasSubstr("'k' cannot be called 'u' here"));
}

TEST_F(LspAnswers, Formatting) {
    EXPECT_THAT(editor.about("formatting"), IsEmpty());
    editor.type(7, 14, 17, "-d");
    const Json edits = editor.about("formatting");
    ASSERT_THAT(edits, SizeIs(1));
    EXPECT_EQ(text_of(edits[0]["range"]), "7:0-8:0");
    EXPECT_EQ(edits[0]["newText"], "  u' = lap(u) - d\n");
    editor.type(7, 0, 0, "(");
    EXPECT_THAT(editor.about("formatting"), IsEmpty()) << "a text with errors stays";
}

TEST_F(LspAnswers, FormattingKeepsLineEnds) {
    editor.open("domain { grid: 8, 8 }\r\nstage one: turing_spots{}\r\n");
    const Json edits = editor.about("formatting");
    ASSERT_THAT(edits, SizeIs(1));
    EXPECT_EQ(edits[0]["newText"], "stage one: turing_spots { }\r\n");
}

TEST_F(LspAnswers, Outline) {
    const Json symbols = editor.about("documentSymbol");
    std::vector<std::string> names;
    for (const Json& symbol : symbols) names.push_back(symbol["name"]);
    EXPECT_THAT(names, ElementsAre("half", "waves", "one", "two", "picture"));
    EXPECT_EQ(symbols[1]["children"][0]["detail"], "species");
    EXPECT_EQ(text_of(symbols[1]["range"]), "3:0-8:1");
    EXPECT_EQ(text_of(symbols[1]["selectionRange"]), "3:7-3:12");
    const Json folds = editor.about("foldingRange");
    ASSERT_THAT(folds, SizeIs(3));
    EXPECT_EQ(folds[0], Json({{"startLine", 3}, {"endLine", 8}}));
    EXPECT_EQ(folds[2], Json({{"startLine", 0}, {"endLine", 1}, {"kind", "comment"}}));
}

TEST_F(LspAnswers, SemanticTokens) {
    const Json data = editor.about("semanticTokens/full")["data"];
    ASSERT_EQ(data.size() % 5, 0u);
    std::size_t line = 0, column = 0;
    std::map<std::pair<std::size_t, std::size_t>, Json> tokens;
    for (std::size_t k = 0; k < data.size(); k += 5) {
        line += data[k].get<std::size_t>();
        column = data[k + 1].get<std::size_t>() + (data[k] == 0 ? column : 0);
        tokens[{line, column}] = Json{data[k + 2], data[k + 3], data[k + 4]};
    }
    EXPECT_EQ((tokens[{0, 0}]), Json({18, 2, 0})) << "a comment";
    EXPECT_EQ((tokens[{4, 2}]), Json({1, 3, 1})) << "the declaration of a species";
    EXPECT_EQ((tokens[{5, 5}]), Json({3, 0, 0})) << "a number";
    EXPECT_EQ((tokens[{6, 11}]), Json({1, 4, 0})) << "a parameter";
    EXPECT_EQ((tokens[{11, 2}]), Json({2, 4, 2})) << "a parameter of the library";
    EXPECT_FALSE(tokens.contains({7, 3})) << "a prime";
}

TEST_F(LspAnswers, Colours) {
    const Json colours = editor.about("documentColor");
    ASSERT_THAT(colours, SizeIs(1));
    EXPECT_EQ(text_of(colours[0]["range"]), "13:17-13:36");
    EXPECT_EQ(colours[0]["color"], Json({{"red", 1}, {"green", 0.5}, {"blue", 0.2}, {"alpha", 1}}));
    const Json texts =
        editor.about("colorPresentation", {{"color", {{"red", 0.25}, {"green", 2}, {"blue", 0}}}});
    EXPECT_EQ(texts[0]["label"], "rgb(0.25, 1, 0)");
}

TEST_F(LspAnswers, CodeActionsDoWhatHintsSay) {
    editor.type(6, 11, 12, "kk");
    const Json diagnostics = editor.diagnostics();
    ASSERT_THAT(diagnostics, SizeIs(1));
    const Json actions = editor.about("codeAction", {{"range", diagnostics[0]["range"]},
                                                     {"context", {{"diagnostics", diagnostics}}}});
    ASSERT_THAT(actions, SizeIs(1));
    EXPECT_EQ(actions[0]["title"], "Write 'k * k'");
    EXPECT_EQ(actions[0]["diagnostics"][0]["message"], diagnostics[0]["message"]);
    const Json edit = actions[0]["edit"]["changes"][editor.uri()][0];
    EXPECT_EQ(text_of(edit["range"]), "6:11-6:13");
    EXPECT_EQ(edit["newText"], "k * k");
    const Json elsewhere = {{"start", {{"line", 0}, {"character", 0}}},
                            {"end", {{"line", 0}, {"character", 1}}}};
    EXPECT_THAT(editor.about("codeAction", {{"range", elsewhere}}), IsEmpty());
}

TEST_F(LspAnswers, TextsThatWereNeverCorrect) {
    editor.open("system s {\n  u: 1\n  u' = -\n");
    EXPECT_THAT(editor.diagnostics(), Not(IsEmpty()));
    EXPECT_THAT(hover(2, 2), IsEmpty());
    EXPECT_THAT(names(2, 8), Contains("lap"));
    EXPECT_THAT(ranges(editor.at("references", 1, 2)), SizeIs(2));
    for (const std::string& text :
         {std::string("\0stage\0", 7), std::string("\xef\xbb\xbf# x\r\r\n"), std::string(),
          std::string(1 << 20, '#'),
          std::string("stage s: turing_spots { a: ") + std::string(100'000, '(') + "}"}) {
        editor.open(text);
        EXPECT_TRUE(editor.diagnostics().is_array());
        for (const char* method : {"documentSymbol", "foldingRange", "semanticTokens/full",
                                   "documentColor", "formatting", "documentLink"}) {
            EXPECT_FALSE(editor.about(method).is_null()) << method;
        }
        for (const char* method : {"hover", "completion", "definition", "prepareRename"}) {
            editor.at(method, 0, 3);
        }
    }
}

}  // namespace
}  // namespace cascade::lsp::test
