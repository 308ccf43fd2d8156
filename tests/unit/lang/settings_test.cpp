// Completion and hints contain every setting of the table.
#include "check_helpers.h"
#include "lang/service/known_names.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace cascade::test {
namespace {

using ::testing::Contains;

template <typename Visit>
void for_each_setting(const Visit& visit) {
    for (std::size_t k = 0; k < setting_count; ++k) visit(static_cast<Setting>(k));
}

/// A script with this setting in a block.
std::string set_in(SettingBlock block, std::string_view word) {
    const std::string plain = "system s { u: 1; u' = 0 }\nstage a: s { }\n";
    switch (block) {
        case SettingBlock::stage:
        case SettingBlock::field_stage:
            return fmt::format("system s {{ u: 1; u' = 0 }}\nstage a: s {{ {}: 1 }}\n", word);
        case SettingBlock::domain:
        case SettingBlock::side: return fmt::format("domain {{ {}: 1 }}\n{}", word, plain);
        case SettingBlock::picture: return fmt::format("picture {{ {}: 1 }}\n{}", word, plain);
        case SettingBlock::cells:
            return fmt::format("cells s {{ {}: 1 }}\nstage a: s {{ founders: 1; iterations: 1 }}\n",
                               word);
        case SettingBlock::cell_stage:
            return fmt::format("cells s {{ }}\nstage a: s {{ {}: 1; iterations: 1 }}\n", word);
        case SettingBlock::system: break;
    }
    return fmt::format("system s {{ {}: \"x\"; u: 1; u' = 0 }}\nstage a: s {{ }}\n", word);
}

std::vector<std::string> hints_about(const std::string& script) {
    std::vector<std::string> hints;
    for (const Diagnostic& each : check_text(script)->diagnostics.sorted())
        hints.push_back(each.hint);
    return hints;
}

TEST(Settings, AreSuggestedWhereTheyAreMisspelt) {
    for_each_setting([](Setting setting) {
        const std::string word(info(setting).word);
        std::vector<std::string> slips{word + "q"};
        if (word.size() > 3) slips.push_back(word.substr(0, 2) + word.substr(3));
        for (const std::string& slip : slips) {
            EXPECT_THAT(hints_about(set_in(info(setting).block, slip)),
                        Contains(fmt::format("did you mean '{}'?", word)))
                << slip;
        }
    });
}

TEST(Settings, OfTheDomainRefuseNonsense) {
    for_each_setting([](Setting setting) {
        if (info(setting).block != SettingBlock::domain) return;
        const std::string script =
            fmt::format("domain {{ {}: nowhere }}\nsystem s {{ u: 1; u' = 0 }}\nstage a: s {{ }}\n",
                        info(setting).word);
        EXPECT_TRUE(check_text(script)->diagnostics.has_errors()) << script;
    });
}

TEST(Settings, AreSuggestedInSystemsToo) {
    EXPECT_THAT(hints_about("system s { iteratons: 5; u: 1; u' = 0 }\nstage a: s { }\n"),
                Contains("did you mean 'iterations'?"));
}

TEST(Settings, AreCompletedAndTheirWordsAre) {
    std::vector<std::string> names;
    for (KnownName& known : known_names(Program())) names.push_back(std::move(known.name));
    for_each_setting([&](Setting setting) {
        EXPECT_THAT(names, Contains(std::string(info(setting).word)));
        for (const std::string& word : words_taken_by(setting)) EXPECT_THAT(names, Contains(word));
    });
    for (const std::string_view keyword : keywords) {
        EXPECT_THAT(names, Contains(std::string(keyword)));
    }
}

TEST(Settings, OfAnotherBlockAreToldWhereTheyBelong) {
    EXPECT_THAT(hints_about(set_in(SettingBlock::stage, "mesh")),
                Contains("it is a setting of the domain"));
    EXPECT_THAT(hints_about(set_in(SettingBlock::domain, "tolerance")),
                Contains("it is a setting of a stage"));
    EXPECT_THAT(hints_about(set_in(SettingBlock::picture, "metric")),
                Contains("it is a setting of the domain"));
    EXPECT_THAT(hints_about(set_in(SettingBlock::domain, "color")),
                ::testing::Each(::testing::Not("")));
}

TEST(Settings, TakeTheirWords) {
    const auto faults_of = [](std::string_view setting, std::string_view word) {
        return check_text(fmt::format("domain {{ surface: sphere; {}: {} }}\n"
                                      "system s {{ u: 1; u' = 0 }}\nstage a: s {{ }}\n",
                                      setting, word))
            ->faults();
    };
    for (const std::string& word : words_taken_by(Setting::directions)) {
        for (const std::string& fault : faults_of("directions", word)) {
            EXPECT_EQ(fault.find("'directions' must be axis"), std::string::npos) << fault;
        }
    }
    for (const Setting setting :
         {Setting::cells, Setting::laplacian, Setting::up, Setting::precision}) {
        for (const std::string& word : words_taken_by(setting)) {
            EXPECT_THAT(faults_of(info(setting).word, word), ::testing::IsEmpty()) << word;
        }
    }
    for (const std::string& word : words_taken_by(Setting::surface)) {
        const auto checked =
            check_text(fmt::format("domain {{ surface: {} }}\n"
                                   "system s {{ u: 1; u' = 0 }}\nstage a: s {{ }}\n",
                                   word));
        for (const std::string& fault : checked->faults()) {
            EXPECT_EQ(fault.find("'surface' takes three expressions"), std::string::npos) << fault;
        }
    }
}

}  // namespace
}  // namespace cascade::test
