// Listings of systems: defaults, ranges and comments.
#include "lang/print/system_listing.h"

#include "lang/syntax/parse.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

constexpr const char* listed_systems = R"(
## Grows by itself.
system grow {
  title: "Growth"
  iterations: 100
  i: 1..2
  u[i]: min(1,
            2)              ## how much
  feed: 0.037 in 0 .. 1/10 step 0.01   ## supply
  kill: 0.06 in 0 .. 1
  start_of_all: random(1, 0.1) + random(2, 0.2)   ## noise
  u[i]' = feed
}
system more: grow { feed: 2 }
)";

struct Listing : ::testing::Test {
    Sources sources;
    Diagnostics diagnostics;
    ast::Script script = parse(sources.add("test.cascade", listed_systems), sources, diagnostics);
};

TEST_F(Listing, ShowsDefaultsRangesAndDocs) {
    EXPECT_EQ(print_system_listing(script, sources, "grow"),
              "  index     i            1 .. 2\n"
              "  species   u[i]         min(1, 2)                          how much\n"
              "  parameter feed         0.037      in 0 .. 1/10 step 0.01  supply\n"
              "  parameter kill         0.06       in 0 .. 1\n"
              "  parameter start_of_all random(1, 0.1) + random(2, 0.2)"
              "                          noise\n"
              "  setting   iterations   100\n");
}

TEST_F(Listing, ShowsADerivedSystemAsAWhole) {
    const std::string lines = print_system_listing(script, sources, "more");
    // Range and doc comment stay with the name.
    EXPECT_NE(lines.find("feed         2          in 0 .. 1/10 step 0.01  supply\n"),
              std::string::npos)
        << lines;
    EXPECT_NE(lines.find("kill         0.06"), std::string::npos) << lines;
    EXPECT_EQ(print_system_listing(script, sources, "unknown"), "");
}

TEST_F(Listing, FindsWhatASystemSaysOfItself) {
    EXPECT_EQ(system_words(script, sources, "grow"),
              (std::vector<std::string>{"Grows by itself.", "Growth"}));
    EXPECT_EQ(system_words(script, sources, "more"), std::vector<std::string>{"Growth"});
}

}  // namespace
}  // namespace cascade
