// Formulas with lengths of the domain, such as domain.width, mean the same as formulas with the
// numbers of these lengths.
#include "check_helpers.h"

#include "lang/program/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cascade::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string script_with(const std::string& rate, const std::string& domain,
                        const std::string& before = "") {
    return before + "system s { u: 1; u' = lap(u) + " + rate + " }\ndomain { " + domain +
           " }\nstage a: s { iterations: 1 }\n";
}

std::string printed(const std::string& rate, const std::string& domain,
                    const std::string& before = "") {
    const auto checked = check_text(script_with(rate, domain, before));
    EXPECT_THAT(checked->faults(), IsEmpty());
    return checked->program ? print_program(*checked->program) : "";
}

std::vector<std::string> faults(const std::string& rate, const std::string& domain) {
    return check_text(script_with(rate, domain))->faults();
}

TEST(DomainLengths, AreNumbersAndPlaces) {
    const std::string domain = "grid: 200, 100; extent: 10, 5";
    const std::string as_spacing = "grid: 200, 100; spacing: 0.05";
    EXPECT_EQ(printed("domain.width + domain.height + domain.spacing", domain),
              printed("10 + 5 + 0.05", as_spacing));
    EXPECT_EQ(printed("domain.x + domain.y", domain), printed("x * 10 + y * 10", as_spacing));
    EXPECT_EQ(printed("domain.depth + domain.z", "grid: 4, 4, 8; extent: 2, 2, 4"),
              printed("4 + z * 4", "grid: 4, 4, 8; spacing: 0.5"));
    EXPECT_EQ(printed("domain.width", "grid: 64, 64"), printed("64", "grid: 64, 64"));
}

TEST(DomainLengths, StandInFunctionsAndConstants) {
    const std::string before = "let k = 2 * pi / domain.width\nfn wave(q) = cos(q * domain.x)\n";
    EXPECT_EQ(printed("wave(3 * k)", "grid: 50; extent: 5", before),
              printed("cos(3 * (2 * pi / 5) * (x * 5))", "grid: 50; spacing: 0.1"));
}

TEST(DomainLengths, IntegralsCountCellsWithTheirSize) {
    EXPECT_EQ(printed("integral(u over domain)", "grid: 20; extent: 10"),
              printed("sum(u over domain) * 0.5", "grid: 20; spacing: 0.5"));
    EXPECT_EQ(printed("integral(u over domain)", "grid: 20, 20; extent: 10"),
              printed("sum(u over domain) * 0.25", "grid: 20, 20; spacing: 0.5"));
    EXPECT_EQ(printed("integral(u^2 over domain)", "grid: 4, 4, 4; spacing: 0.5"),
              printed("sum(u^2 over domain) * 0.125", "grid: 4, 4, 4; spacing: 0.5"));
    // On models a sum is already an integral.
    EXPECT_EQ(printed("integral(u over domain)", "surface: sphere; cells: 100"),
              printed("sum(u over domain) * 1", "surface: sphere; cells: 100"));
}

TEST(DomainLengths, SaysWhatIsNone) {
    EXPECT_THAT(faults("domain.area", "grid: 8, 8"),
                ElementsAre("1:39: 'area' is not a length of the domain | write domain.x, .y, "
                            ".z, .width, .height, .depth or .spacing"));
    EXPECT_THAT(faults("domain.x", "surface: sphere; cells: 100"),
                ElementsAre("1:39: lengths of the domain exist only for a grid with straight "
                            "axes | "
                            "x, y and z are from 0 to 1 along the model's longest side"));
    EXPECT_THAT(faults("integral(u)", "grid: 8, 8"),
                ElementsAre("1:32: integral needs 'over' | write integral(e over domain)"));
    EXPECT_THAT(check_text(
                    "system s { u: 1; u' = lap(u) }\nstage a: s { iterations: domain.width }\n")
                    ->faults(),
                ElementsAre("2:33: lengths of the domain cannot be read here | read them in "
                            "values, rates, definitions, masks or pictures"));
}

TEST(DomainLengths, ExtentsFitTheGrid) {
    EXPECT_THAT(faults("0", "grid: 100, 50; extent: 10, 6"),
                ElementsAre(HasSubstr("cells would be 0.1 long along one side and 0.12 along "
                                      "another | cells must be as long as they are wide: with "
                                      "this grid the side must be 5 long")));
    EXPECT_THAT(faults("0", "extent: 10; spacing: 0.1"),
                ElementsAre(HasSubstr("a domain can have an extent or a spacing, but not both")));
    EXPECT_THAT(faults("0", "extent: -1"),
                ElementsAre(HasSubstr("the length of a side must be above 0")));
    EXPECT_THAT(faults("0", "extent: 1e30"),
                ElementsAre(HasSubstr("cells must be from 1e-15 to 1e15 long")));
    EXPECT_THAT(faults("0", "grid: 8, 8; extent: 1, 1, 1/8, 1"),
                ElementsAre(HasSubstr("the domain has three sides at most")));
    EXPECT_THAT(faults("0", "surface: sphere; cells: 100; extent: 10; unit: 0.1"),
                ElementsAre(HasSubstr("can have an extent or a unit, but not both")));
    EXPECT_EQ(printed("domain.width", "grid: 3; extent: 1"), printed("1", "grid: 3; spacing: 1/3"));
}

}  // namespace
}  // namespace cascade::test
