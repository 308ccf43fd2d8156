// `use`, and which files a script may read.
#include "core/file.h"
#include "core/granted_files.h"
#include "run/script/embedded_script.h"
#include "run/script/script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace cascade {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class UsedFilesTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        root_ = fs::path(testing::TempDir()) /
                (std::string("used_files_") + info->name() + "_" + std::to_string(getpid()));
        fs::remove_all(root_);
        fs::create_directories(root_ / "project" / "lib");
    }
    void TearDown() override { fs::remove_all(root_); }

    void write(const std::string& path, const std::string& text) {
        std::ofstream(root_ / path, std::ios::binary) << text;
    }
    Script load(const std::string& path, Overrides overrides = {}) {
        auto file = load_script_file(root_ / path, std::move(overrides));
        EXPECT_TRUE(file) << file.error().message;
        return std::move(file->script);
    }
    std::string messages_of(const std::string& text, Overrides overrides = {}) {
        write("project/main.cascade", text);
        return load("project/main.cascade", std::move(overrides)).messages(false);
    }

    fs::path root_;
};

constexpr const char* run_s = "\nstage a: s { iterations: 2 }\n";

TEST_F(UsedFilesTest, GivesSystemsAndFunctionsAndNothingElse) {
    write("project/lib/coats.cascade",
          "use \"more.cascade\"\nuse \"../main.cascade\"\n"
          "system s { u: half(1); u' = -u }\ndomain { grid: 4 }\n"
          "stage other: s { iterations: 9 }\npicture { color: rgb(1, 1, 1) }\n");
    write("project/lib/more.cascade", "use \"coats.cascade\"\nfn half(x) = x / 2\n");
    write("project/main.cascade",
          std::string("use \"lib/coats.cascade\"\nuse \"lib/more.cascade\"") + run_s);
    const Script script = load("project/main.cascade");
    ASSERT_TRUE(script.program) << script.messages(false);
    EXPECT_EQ(script.messages(false), "");
    ASSERT_EQ(script.program->stages.size(), 1u);
    EXPECT_EQ(script.program->domain.grid.width, 64);
    ASSERT_EQ(script.overrides.used.size(), 2u);
    EXPECT_EQ(script.overrides.used[0].first, "lib/coats.cascade");
    EXPECT_EQ(script.overrides.used[1].first, "lib/more.cascade");
}

TEST_F(UsedFilesTest, FaultsAreToldInTheirFile) {
    write("project/lib/coats.cascade", "system s { u: 1\nu' = betta }\n");
    EXPECT_THAT(messages_of(std::string("use \"lib/coats.cascade\"") + run_s),
                HasSubstr("lib/coats.cascade:2:6: error: 'betta' is not a parameter of s"));
    EXPECT_THAT(messages_of("use \"lib/coats.cascade\"\nsystem s { v: 1; v' = v }"),
                HasSubstr("there are two systems 's'"));
    EXPECT_THAT(messages_of("use \"lib/none.cascade\""),
                testing::AllOf(HasSubstr("main.cascade:1:5: error: "), HasSubstr("none.cascade")));
    EXPECT_THAT(messages_of("use \"lib\""), HasSubstr("main.cascade:1:5: error: "));
    EXPECT_THAT(messages_of("use \"\""), HasSubstr("main.cascade:1:5: error: "));
}

TEST_F(UsedFilesTest, TheTextsTravelWithTheRun) {
    write("project/lib/coats.cascade", "system s { u: 1; u' = -u }\n");
    write("project/main.cascade", std::string("use \"lib/coats.cascade\"") + run_s);
    const Script script = load("project/main.cascade");
    ASSERT_TRUE(script.program);
    fs::remove_all(root_ / "project");
    auto overrides = overrides_from_json(overrides_to_json(script.overrides));
    ASSERT_TRUE(overrides);
    const Script again = load_script(script.name, script.text, script.folder, *overrides);
    EXPECT_TRUE(again.program) << again.messages(false);
}

TEST_F(UsedFilesTest, OnlyFilesBelowTheScriptsFolder) {
    write("outside.cascade", "system s { u: 1; u' = -u }\n");
    write("project/inside.cascade", "system s { u: 1; u' = -u }\n");
    fs::create_symlink(root_ / "outside.cascade", root_ / "project" / "link.cascade");
    fs::create_directories(root_ / "project2");
    write("project2/near.cascade", "system s { u: 1; u' = -u }\n");
    const std::string outside = "lies outside of the script's folder";
    const auto use = [](const std::string& path) { return "use \"" + path + "\"" + run_s; };
    for (const std::string path : {"../outside.cascade", "link.cascade", "../project2/near.cascade",
                                   "lib/../../outside.cascade", "/etc/hostname"}) {
        EXPECT_THAT(messages_of(use(path)), HasSubstr(outside)) << path;
    }
    EXPECT_EQ(messages_of(use("inside.cascade")), "");
    EXPECT_EQ(messages_of(use("lib/../inside.cascade")), "");
    EXPECT_EQ(messages_of(use((root_ / "project/inside.cascade").string())), "");
    Overrides all, folder;
    all.reads.everything = true;
    folder.reads.folders = {root_ / "project2/"};
    EXPECT_EQ(messages_of(use("../outside.cascade"), all), "");
    EXPECT_EQ(messages_of(use("../project2/near.cascade"), folder), "");
    EXPECT_THAT(messages_of(use("../outside.cascade"), folder), HasSubstr(outside));
    EXPECT_EQ(overrides_to_json(all), "{}");  // A picture does not carry rights.
}

}  // namespace
}  // namespace cascade
