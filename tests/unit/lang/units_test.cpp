// Units of numbers: their table, their sizes, and the names of a script's units.
#include "lang/vocabulary/units.h"

#include "lang/check/check.h"
#include "lang/check/dimensionless_groups.h"
#include "lang/syntax/parse.h"
#include "lang/syntax/script_units.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

double size_of(std::string_view text) { return in_base_units(1, unit_of(text)); }

ScriptUnits units_of_text(std::string text) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("script", std::move(text));
    const ast::Script tree = parse(source, sources, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors());
    return units_of(tree);
}

TEST(Units, HaveTheirSizeInBaseUnits) {
    EXPECT_EQ(size_of("km"), 1000);
    EXPECT_EQ(size_of("um"), 1e-6);
    EXPECT_EQ(size_of("h"), 3600);
    EXPECT_EQ(size_of("day"), 86400);
    EXPECT_DOUBLE_EQ(size_of("m^2/s"), 1);
    EXPECT_DOUBLE_EQ(size_of("um^2/h"), 1e-12 / 3600);
    EXPECT_DOUBLE_EQ(size_of("1/min"), 1.0 / 60);
    EXPECT_DOUBLE_EQ(size_of("mM"), 1);
    EXPECT_DOUBLE_EQ(size_of("mol/l"), 1000);
    EXPECT_DOUBLE_EQ(size_of("ml"), 1e-6);
    EXPECT_DOUBLE_EQ(size_of("mV"), 1e-3);
    EXPECT_DOUBLE_EQ(size_of("uF/cm^2"), 1e-2);
}

TEST(Units, AgreeWithProductsOfOthers) {
    const auto same = [](std::string_view a, std::string_view b) {
        EXPECT_EQ(unit_of(a).dimension, unit_of(b).dimension) << a << " and " << b;
        EXPECT_DOUBLE_EQ(size_of(a), size_of(b)) << a << " and " << b;
    };
    same("N", "kg*m/s^2");
    same("Pa", "N/m^2");
    same("J", "N*m");
    same("W", "J/s");
    same("V", "W/A");
    same("S", "A/V");
    same("ohm", "1/S");
    same("F", "A*s/V");
    same("Hz", "1/s");
    same("M", "mol/dm^3");
    same("l", "dm^3");
}

TEST(Units, OtherWordsAreNone) {
    for (const char* word : {"", "C", "in", "x", "kin", "um2", "mmm", "Um", "kh", "u", "ka"}) {
        EXPECT_FALSE(unit_named(word)) << word;
    }
}

TEST(Units, OfTheDomainAndTheDurationAreThoseOfTheScript) {
    const ScriptUnits units = units_of_text(
        "system s { u: 1 uM; D: 1e-14 m^2/s; u' = D * lap(u) }\n"
        "domain { extent: 3 mm }\n"
        "stage a: s { duration: 2 h }\n");
    EXPECT_DOUBLE_EQ(units.convert(1, unit_of("cm")), 10);
    EXPECT_DOUBLE_EQ(units.convert(90, unit_of("min")), 1.5);
    EXPECT_EQ(units.convert(0.3, unit_of("uM")), 0.3);
    EXPECT_EQ(units.name_of(unit_of("m^2/s").dimension), "mm^2/h");
    EXPECT_EQ(units.name_of(unit_of("mol/m^3/s").dimension), "uM/h");
    EXPECT_EQ(units.name_of(unit_of("1/s").dimension), "1/h");
    EXPECT_EQ(units.name_of({}), "");
    EXPECT_TRUE(units.knows(BaseQuantity::length));
    EXPECT_FALSE(units.knows(BaseQuantity::mass));
}

TEST(Units, WithoutADomainTheFirstOneIsTaken) {
    const ScriptUnits units = units_of_text("system s { u: 1; a: 2 kHz; b: 3 g; u' = 0 }\n");
    EXPECT_DOUBLE_EQ(units.convert(2, unit_of("kHz")), 2000);
    EXPECT_EQ(units.convert(3, unit_of("g")), 3);
    EXPECT_FALSE(units.knows(BaseQuantity::length));
    EXPECT_TRUE(units.knows(BaseQuantity::time));
    EXPECT_TRUE(units_of_text("system s { u: 1; u' = 0 }\n").empty());
}

TEST(Units, ConcentrationsStayAsTheyAreWritten) {
    const ScriptUnits units =
        units_of_text("system s { u: 3 mol/m^3; k: 2 l/mol/s; u' = 0 }\ndomain { extent: 3 um }\n");
    EXPECT_DOUBLE_EQ(units.convert(3, unit_of("mol/m^3")), 3);
    EXPECT_DOUBLE_EQ(units.convert(1, unit_of("M")), 1000);
    EXPECT_EQ(units.name_of(unit_of("mol/m^3/s").dimension), "mol/m^3/s");
    EXPECT_EQ(units.name_of(unit_of("m^3/mol/s").dimension), "1/(mol/m^3)/s");
    EXPECT_DOUBLE_EQ(
        units_of_text("system s { u: 3; k: 2 l/mol/s; u' = 0 }\n").convert(5, unit_of("mol/l")), 5);
}

DimensionlessGroups groups_of(std::string text) {
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("script", std::move(text));
    const ast::Script tree = parse(source, sources, diagnostics);
    const auto program = check(tree, sources, diagnostics);
    EXPECT_TRUE(program);
    return program ? dimensionless_groups(units_of_program(tree, *program), *program, 0)
                   : DimensionlessGroups{};
}

std::string words_of(const DimensionlessGroups& found) {
    std::string text;
    for (const DimensionlessGroup& group : found.groups) {
        for (const GroupFactor& factor : group) {
            text += factor.name + "^" + std::to_string(factor.power) + " ";
        }
        text += "; ";
    }
    for (const std::string& name : found.without_unit) text += "not " + name + "; ";
    return text;
}

TEST(DimensionlessGroups, AreACompleteSet) {
    const std::string system =
        "system s { u: 1 uM; v: 1 uM; D: 2 um^2/s; E: 40 um^2/s; k: 3 /s; c: 2 uM; q: 1 uM/s\n"
        "u' = D * lap(u) - k * (u - c) + q; v' = E * lap(v) - k * v }\n";
    EXPECT_EQ(words_of(groups_of(system + "domain { extent: 3 mm }\nstage a: s { iterations: 1 }")),
              "E^1 D^-1 ; q^1 k^-1 c^-1 ; width^2 D^-1 k^1 ; ");
    EXPECT_EQ(words_of(groups_of(system + "stage a: s { duration: 4 h }")),
              "E^1 D^-1 ; q^1 k^-1 c^-1 ; width^2 D^-1 k^1 ; duration^1 k^1 ; ");
}

TEST(DimensionlessGroups, NeedUnits) {
    EXPECT_EQ(words_of(groups_of("system s { u: 1; D: 2 m^2/s; k: 3; u' = D * lap(u) - k * u }\n"
                                 "stage a: s { iterations: 1 }")),
              "not k; ");
}

TEST(Units, RootsHaveDimensions) {
    const Dimension area = unit_of("m^2").dimension;
    EXPECT_EQ(to_power(area, 0.5), unit_of("m").dimension);
    EXPECT_EQ(to_power(unit_of("m").dimension, 1.0 / 3)->sixths[0], 2);
    EXPECT_FALSE(to_power(area, 0.123));
}

}  // namespace
}  // namespace cascade
