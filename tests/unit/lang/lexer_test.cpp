// The lexer: the tokens of a text, and messages about other characters.
#include "lang/syntax/token.h"
#include "script_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Lexed {
    std::string tokens;  ///< Spellings, separated by one blank. The end is left out.
    std::vector<std::string> faults;
};

Lexed lex_text(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("test", text);
    Lexed result;
    for (const Token& token : lex(source, sources, diagnostics)) {
        if (token.kind == TokenKind::end_of_text) break;
        const bool is_word = token.kind == TokenKind::name || token.kind == TokenKind::number ||
                             token.kind == TokenKind::text;
        if (!result.tokens.empty()) result.tokens += " ";
        if (token.kind == TokenKind::newline) result.tokens += "NL";
        else if (token.kind == TokenKind::garbage) result.tokens += "GARBAGE";
        else if (is_word) result.tokens += token.text;
        else result.tokens += spelling(token.kind);
    }
    result.faults = list_faults(diagnostics, sources);
    return result;
}

std::string tokens_of(const std::string& text) {
    const Lexed lexed = lex_text(text);
    EXPECT_THAT(lexed.faults, IsEmpty()) << text;
    return lexed.tokens;
}

TEST(Lexer, SplitsAStatement) {
    EXPECT_EQ(tokens_of("b' += ka*(a*b-b-beta)"), "b ' += ka * ( a * b - b - beta )");
    EXPECT_EQ(tokens_of("a:if([frozen],4,large.a)"), "a : if ( [ frozen ] , 4 , large . a )");
    EXPECT_EQ(tokens_of("{};<=>= == != = < > + - / ^"), "{ } ; <= >= == != = < > + - / ^");
    EXPECT_EQ(tokens_of("and or not android _x2"), "and or not android _x2");
}

TEST(Lexer, ReadsNumbers) {
    EXPECT_EQ(tokens_of("1 1.5 .25 4. 1e-3 2.5E+10 1/8"), "1 1.5 .25 4. 1e-3 2.5E+10 1 / 8");
    EXPECT_EQ(tokens_of("stage1.p"), "stage1 . p");
    EXPECT_EQ(tokens_of("1..3 1. .. .5 0 ..1.5"), "1 .. 3 1. .. .5 0 .. 1.5");
}

TEST(Lexer, ReadsTexts) {
    EXPECT_EQ(tokens_of("mesh: \"a # b.ply\" # c"), "mesh : \"a # b.ply\"");
    EXPECT_EQ(tokens_of("\"\""), "\"\"");
    EXPECT_EQ(tokens_of("\"\xce\xb2\""), "\"\xce\xb2\"");
}

TEST(Lexer, SeveralLineEndsAreOne) {
    EXPECT_EQ(tokens_of("a\n\n  # remark\n\r\n\rb\n"), "a NL b NL");
    EXPECT_EQ(tokens_of("a\r\nb\rc"), "a NL b NL c");
    EXPECT_EQ(tokens_of(""), "");
}

TEST(Lexer, AByteOrderMarkIsNothing) {
    EXPECT_EQ(tokens_of("\xef\xbb\xbf"
                        "a: 1"),
              "a : 1");
}

TEST(Lexer, EndsWithEndOfText) {
    Sources sources;
    Diagnostics diagnostics;
    const auto tokens = lex(sources.add("test", "ab"), sources, diagnostics);
    ASSERT_EQ(tokens.size(), 2u);
    EXPECT_EQ(tokens[1].kind, TokenKind::end_of_text);
    EXPECT_EQ(tokens[1].span, (Span{0, 2, 2}));
}

TEST(Lexer, PrintsTokens) {
    Sources sources;
    Diagnostics diagnostics;
    const auto tokens =
        lex(sources.add("test", "\n\n    ka: \"x\"\n\xce\x92 1"), sources, diagnostics);
    EXPECT_EQ(print_tokens(tokens, sources),
              "1:1 line end\n"
              "3:5 name \"ka\"\n"
              "3:7 :\n"
              "3:9 text in quotes \"x\"\n"
              "3:12 line end\n"
              "4:1 unreadable characters \"\xce\x92\"\n"
              "4:3 number \"1\"\n"
              "4:4 end of text\n");
}

/// A text, its tokens and its only message.
struct Fault {
    std::string text, tokens, message;
};

TEST(Lexer, ReadsOperatorsOfOtherLanguagesAsWhatTheyMean) {
    const std::string not_ours = "' is not an operator of the language | ";
    const std::vector<Fault> faults = {
        {"a && b", "a and b", "1:3 '&&" + not_ours + "write 'and'"},
        {"a & b", "a and b", "1:3 '&" + not_ours + "write 'and'"},
        {"a || b", "a or b", "1:3 '||" + not_ours + "write 'or'"},
        {"!a", "not a", "1:1 '!" + not_ours + "write 'not'"},
        {"a**2", "a ^ 2", "1:2 '**" + not_ours + "write '^' for a power"},
        {"a % 2", "a GARBAGE 2",
         "1:3 '%" + not_ours + "write mod(a, b) for a % b, 0.05 for 5 %; '#' begins a comment"},
        {"a <> b", "a != b", "1:3 '<>" + not_ours + "write '!='"},
        {"a === b", "a == b", "1:3 '===" + not_ours + "write '=='"},
        {"a => b", "a >= b", "1:3 '=>" + not_ours + "write '>='"},
        {"a := b", "a : b", "1:3 ':=" + not_ours + "write ':' for a value, '=' for a definition"},
        {"a // b\nc", "a NL c", "1:3 a comment begins with '#' | write '#'"},
        {"a /* b\nc */ d", "a d", "1:3 a comment begins with '#' | write '#'"},
    };
    for (const Fault& fault : faults) {
        const Lexed lexed = lex_text(fault.text);
        EXPECT_EQ(lexed.tokens, fault.tokens) << fault.text;
        EXPECT_THAT(lexed.faults, ElementsAre(fault.message)) << fault.text;
    }
}

TEST(Lexer, ReadsLookAlikesAsWhatTheyMean) {
    const std::string nothing = " has no meaning in the language | write ";
    const std::vector<Fault> faults = {
        {"a\u2019 = 1", "a ' = 1", "1:2 '\u2019' (U+2019)" + nothing + "the apostrophe '"},
        {"a \u2013 b", "a - b", "1:3 '\u2013' (U+2013)" + nothing + "'-'"},
        {"a \u2022 b", "a * b", "1:3 '\u2022' (U+2022)" + nothing + "'*'"},
        {"a \u00f7 b", "a / b", "1:3 '\u00f7' (U+00F7)" + nothing + "'/'"},
        {"a\uff1a 1", "a : 1", "1:2 '\uff1a' (U+FF1A)" + nothing + "':'"},
        {"a\u207f", "a", "1:2 '\u207f' (U+207F)" + nothing + "'^n'"},
        {"\u201ctan\u201d + 1", "GARBAGE + 1", "1:1 '\u201c' (U+201C)" + nothing + "'\"'"},
        {"a:\u00a0\u00a01", "a : 1", "1:3 U+00A0 is not an ordinary space | write a plain blank"},
    };
    for (const Fault& fault : faults) {
        const Lexed lexed = lex_text(fault.text);
        EXPECT_EQ(lexed.tokens, fault.tokens) << fault.text;
        EXPECT_THAT(lexed.faults, ElementsAre(fault.message)) << fault.text;
    }
}

TEST(Lexer, SpellsLettersOfOtherAlphabets) {
    const std::vector<Fault> faults = {
        {"\u0392: 1", "GARBAGE : 1", "1:1 '\u0392' (U+0392) is not a letter of a name | write 'B'"},
        {"diff_\U0001d6fc2", "GARBAGE",
         "1:1 '\U0001d6fc' (U+1D6FC) is not a letter of a name | write 'diff_alpha2'"},
        {"\U0001d462", "GARBAGE",
         "1:1 '\U0001d462' (U+1D462) is not a letter of a name | write 'u'"},
        {"u\u0307", "GARBAGE",
         "1:1 the mark U+0307 above or below a letter cannot be part of a name | write u' for a "
         "rate"},
        {"k\u0430", "GARBAGE", "1:1 '\u0430' (U+0430) is not a letter of a name | write 'ka'"},
        {"\u6f22", "GARBAGE",
         "1:1 '\u6f22' (U+6F22) is not a letter of a name | names are of a to z, A to Z, 0 to 9, "
         "Greek letters and _"},
    };
    for (const Fault& fault : faults) {
        const Lexed lexed = lex_text(fault.text);
        EXPECT_EQ(lexed.tokens, fault.tokens) << fault.text;
        EXPECT_THAT(lexed.faults, ElementsAre(fault.message)) << fault.text;
    }
}

TEST(Lexer, ReportsStrayCharactersOncePerRun) {
    const std::vector<Fault> faults = {
        {"a $$ b", "a GARBAGE b",
         "1:3 '$$' has no meaning in the language | formulas have no '$'; leave it out"},
        {"a ? b", "a GARBAGE b",
         "1:3 '?' has no meaning in the language | a choice is written if(condition, a, b)"},
        {"a \\\nb", "a GARBAGE NL b",
         "1:3 '\\' has no meaning in the language | a statement continues on the next line inside "
         "( ) and after an operator"},
        {"a \x07 b", "a GARBAGE b",
         "1:3 U+0007 is an invisible character without a meaning here | take it out"},
        {"\"open\nb", "GARBAGE NL b",
         "1:1 this text is never closed | a text ends with '\"' on its line"},
        {"3abc", "GARBAGE", "1:1 '3abc' is not a number | write '3 * abc'"},
        {"1.2.3", "GARBAGE", "1:1 '1.2.3' is not a number"},
        {"2e", "GARBAGE", "1:1 '2e' is not a number | an exponent has digits, as in 1e-3"},
    };
    for (const Fault& fault : faults) {
        const Lexed lexed = lex_text(fault.text);
        EXPECT_EQ(lexed.tokens, fault.tokens) << fault.text;
        EXPECT_THAT(lexed.faults, ElementsAre(fault.message)) << fault.text;
    }
}

TEST(Lexer, NamesBytesThatAreNotUtf8) {
    EXPECT_THAT(lex_text("a \xff b").faults,
                ElementsAre("1:3 byte 0xff is not valid UTF-8 | save the script as UTF-8"));
    EXPECT_EQ(lex_text("a \xff b").tokens, "a GARBAGE b");
    EXPECT_THAT(lex_text("a\n\xc3\x28").faults,
                ElementsAre("2:1 byte 0xc3 is not valid UTF-8 | save the script as UTF-8"));
    EXPECT_THAT(lex_text("\xff\xfe\x80\x81\x82\x83").faults,
                ElementsAre("1:1 bytes 0xff 0xfe 0x80 0x81 and 2 more are not valid UTF-8 | "
                            "save the script as UTF-8"));
    // Comments and texts are part of the script.
    EXPECT_THAT(lex_text("# gr\xf6\xdf"
                         "e")
                    .faults,
                ElementsAre("1:5 bytes 0xf6 0xdf are not valid UTF-8 | save the script as UTF-8"));
    EXPECT_EQ(lex_text("\"\xf6\"").tokens, "GARBAGE");
    EXPECT_THAT(lex_text("\"\xf6\"").faults,
                ElementsAre("1:2 byte 0xf6 is not valid UTF-8 | save the script as UTF-8"));
}

TEST(Lexer, NamesNulBytes) {
    const std::string one("a\0b", 3), three("a\0\0\0b", 5);
    EXPECT_EQ(lex_text(one).tokens, "a GARBAGE b");
    EXPECT_THAT(lex_text(one).faults,
                ElementsAre("1:2 a NUL byte (0x00) is not text | is this file a script?"));
    EXPECT_THAT(lex_text(three).faults,
                ElementsAre("1:2 3 NUL bytes (0x00) are not text | is this file a script?"));
}

TEST(Lexer, RefusesMoreTokensThanAScriptCanHave) {
    const Lexed lexed = lex_text(std::string(most_tokens + 1, '('));
    EXPECT_EQ(lexed.tokens, "");
    EXPECT_THAT(lexed.faults, ElementsAre("1:1 this script has more than 4194304 words"));
}

}  // namespace
}  // namespace cascade
