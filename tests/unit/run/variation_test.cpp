// The values that --vary accepts, and the runs that it makes.
#include "core/csv.h"
#include "run/commands/variation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <limits>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> values_of(const std::string& text) {
    const auto variation = parse_variation(text);
    EXPECT_TRUE(variation) << text;
    return variation ? variation->values : std::vector<std::string>{};
}

std::string fault_of(const std::string& text) {
    const auto variation = parse_variation(text);
    EXPECT_FALSE(variation) << text;
    return variation ? "" : variation.error().message;
}

TEST(Variation, RangesHaveBothEnds) {
    EXPECT_THAT(values_of("gs.feed=0.02..0.06:5"),
                ElementsAre("0.02", "0.03", "0.04", "0.05", "0.06"));
    EXPECT_EQ(parse_variation("gs.feed=0..1:2")->name, "gs.feed");
    // Falling values, exactly 0 in the middle, fractions, blanks, and a single value.
    EXPECT_THAT(values_of("a = 0.3 .. -0.3 : 7"),
                ElementsAre("0.3", "0.2", "0.1", "0", "-0.1", "-0.2", "-0.3"));
    EXPECT_THAT(values_of("ka=1/400..1/100:4"), ElementsAre("0.0025", "0.005", "0.0075", "0.01"));
    EXPECT_THAT(values_of("a=1e-3..3e3:1"), ElementsAre("0.001"));
}

TEST(Variation, RangesOfEqualRatios) {
    EXPECT_THAT(values_of("F=1e-3..1:4:log"), ElementsAre("0.001", "0.01", "0.1", "1"));
    EXPECT_THAT(values_of("F = -8 .. -1 : 4 : log"), ElementsAre("-8", "-4", "-2", "-1"));
    EXPECT_THAT(values_of("F=1/3..27:1:log"), ElementsAre("0.3333333333"));
    for (const char* text : {"F=0..1:3:log", "F=-1..1:3:log", "F=1..0:3:log"}) {
        EXPECT_THAT(fault_of(text), HasSubstr("both above 0 or both below 0")) << text;
    }
    EXPECT_THAT(fault_of("F=1..10:log"), HasSubstr("':' and the number of values are missing"));
}

TEST(Variation, NamesMayVaryTogether) {
    const std::vector<Variation> varied = {*parse_variation("(a, s.b) = (1, x), (2,[y, z])"),
                                           {"c", {"7"}}};
    EXPECT_EQ(*count_runs(varied), 2u);
    EXPECT_THAT(names_of(varied), ElementsAre("a", "s.b", "c"));
    EXPECT_THAT(values_of_run(varied, 1), ElementsAre("2", "[y, z]", "7"));
    EXPECT_EQ(*parse_variation(text_of(varied[0])), varied[0]);
    EXPECT_EQ(folder_name(varied, values_of_run(varied, 0)), "a=1,s.b=x,c=7");
    EXPECT_THAT(fault_of("(a,b)=(1,2),3"), HasSubstr("'3' is not 2 values in brackets"));
    EXPECT_THAT(fault_of("(a,b)=0..1:3"), HasSubstr("a range can vary only one name"));
    EXPECT_FALSE(count_runs(std::vector<Variation>{{"(a, b)", {"(1, 2)"}}, {"b", {"3"}}}));
    // Brackets may belong to a value.
    EXPECT_THAT(values_of("a=(1 + 2),(3)"), ElementsAre("(1 + 2)", "(3)"));
}

TEST(Variation, RangesOfOtherProgramsAreExplained) {
    const auto hint_of = [](const std::string& text) {
        const auto variation = parse_variation(text);
        return variation ? "" : variation.error().hint;
    };
    EXPECT_EQ(hint_of("F=0.02:0.06:5"), "write F=0.02..0.06:5");
    EXPECT_EQ(hint_of("gs.feed = -1 : 1 : 0.5"), "write gs.feed=-1..1:COUNT");
    EXPECT_EQ(hint_of("k=0:1/3:4"), "write k=0..1/3:4");
}

TEST(Variation, ListsAreExpressions) {
    EXPECT_THAT(values_of("a=1,2,5"), ElementsAre("1", "2", "5"));
    EXPECT_THAT(values_of("b=1/400, random(12, 0.1) ,if([a]<1,2,3)"),
                ElementsAre("1/400", "random(12, 0.1)", "if([a]<1,2,3)"));
    EXPECT_THAT(values_of("frozen=b < 4"), ElementsAre("b < 4"));
}

TEST(Variation, SaysWhatIsWrong) {
    EXPECT_THAT(fault_of("feed"), HasSubstr("there is no '='"));
    EXPECT_THAT(fault_of("=1,2"), HasSubstr("there is no name"));
    EXPECT_THAT(fault_of("a="), HasSubstr("a value is missing"));
    EXPECT_THAT(fault_of("a=1,,2"), HasSubstr("a value is missing"));
    EXPECT_THAT(fault_of("a=0..1"), HasSubstr("the number of values"));
    EXPECT_THAT(fault_of("a=x..1:3"), HasSubstr("must be numbers"));
    EXPECT_THAT(fault_of("a=0..1/0:3"), HasSubstr("must be numbers"));
    EXPECT_THAT(fault_of("a=nan..1:3"), HasSubstr("must be numbers"));
    for (const char* count : {"", "0", "-1", "2.5", "10001", "99999999999999999999"}) {
        EXPECT_THAT(fault_of(std::string("a=0..1:") + count), HasSubstr("1 to 10000 values"));
    }
}

TEST(Variation, TheFirstRunsFastest) {
    const std::vector<Variation> varied = {{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}};
    EXPECT_EQ(*count_runs(varied), 6u);
    EXPECT_THAT(values_of_run(varied, 0), ElementsAre("1", "x"));
    EXPECT_THAT(values_of_run(varied, 1), ElementsAre("2", "x"));
    EXPECT_THAT(values_of_run(varied, 5), ElementsAre("2", "z"));
}

TEST(Variation, RefusesTwiceAndTooMany) {
    const auto fault = [](const std::vector<Variation>& varied) {
        const auto runs = count_runs(varied);
        EXPECT_FALSE(runs);
        return runs ? "" : runs.error().message;
    };
    EXPECT_THAT(fault({{"a", {"1"}}, {"a", {"2"}}}), HasSubstr("'a' is varied twice"));
    EXPECT_THAT(fault({{"a", {"1", "2", "1"}}}), HasSubstr("'1' occurs twice"));
    std::vector<Variation> many;
    for (const char* name : {"a", "b", "c", "d", "e"}) {
        many.push_back({name, {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"}});
    }
    EXPECT_THAT(fault(many), HasSubstr("more than 10000 runs"));
}

TEST(Variation, SeedsAreNoParameters) {
    Overrides base;
    base.sets = {"ka=1"};
    const std::vector<Variation> varied = {{"s.beta", {"2"}}, {"seed", {"7"}}};
    const auto overrides = overrides_of_run(base, varied, values_of_run(varied, 0));
    ASSERT_TRUE(overrides);
    EXPECT_THAT(overrides->sets, ElementsAre("ka=1", "s.beta=2"));
    EXPECT_EQ(overrides->seed, 7u);
    const std::vector<Variation> wrong = {{"seed", {"-1"}}};
    EXPECT_FALSE(overrides_of_run(base, wrong, values_of_run(wrong, 0)));
}

TEST(Csv, ReadsRowsWithTheirPlaces) {
    const auto rows = read_csv(
        "\xef\xbb\xbf"
        "a , \"b\"\"c\"\r\n\n ä, 2\r\"3\n4\", ,\n");
    ASSERT_TRUE(rows);
    std::vector<std::string> cells;
    for (const auto& row : *rows) {
        for (const CsvCell& cell : row) {
            cells.push_back(fmt::format("{}:{} {}", cell.line, cell.column, cell.text));
        }
        cells.emplace_back("end");
    }
    EXPECT_THAT(cells, ElementsAre("1:1 a", "1:5 b\"c", "end", "3:2 ä", "3:5 2", "end", "4:1 3\n4",
                                   "5:5 ", "5:6 ", "end"));
    EXPECT_TRUE(read_csv("")->empty());
    EXPECT_EQ(read_csv("\"\"")->size(), 1u);
    EXPECT_EQ(read_csv("a,\n \"b").error().message, "2:2: this quoted cell has no end");
    EXPECT_EQ(read_csv("\"b\" c").error().message, "1:5: there is text after a quoted cell");
}

TEST(Csv, QuotesWhatNeedsIt) {
    const std::vector<std::string> cells = {"a", "", "1,5", "say \"hi\"", "two\nlines"};
    EXPECT_EQ(csv_row(cells), "a,,\"1,5\",\"say \"\"hi\"\"\",\"two\nlines\"\n");
    EXPECT_EQ(csv_number(0.1, Precision::single), "0.1");
    EXPECT_EQ(csv_number(static_cast<double>(0.1F)), "0.100000001");
    EXPECT_EQ(csv_number(3.0), "3");
    EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
    // Nine digits are enough for every binary32.
    for (const float value : {1.0F / 3, 16777217.0F, 1e-38F, 3.4e38F}) {
        EXPECT_EQ(std::strtof(csv_number(value, Precision::single).c_str(), nullptr), value);
    }
}

}  // namespace
}  // namespace cascade
