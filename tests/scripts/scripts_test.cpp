// Every script in these folders gives a test for each case and configuration. wrong/ contains
// scripts that must fail.
#include "core/file.h"
#include "run_script.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

namespace cascade::test {
namespace {

namespace fs = std::filesystem;

const fs::path scripts_folder = fs::path(CASCADE_SOURCE_DIR) / "tests" / "scripts";

std::vector<fs::path> scripts_below(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".cascade") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

struct LoadedScripts {
    fs::path path;
    ScriptFile file;
};

std::shared_ptr<const LoadedScripts> load(const fs::path& path) {
    auto loaded = std::make_shared<LoadedScripts>();
    loaded->path = path;
    loaded->file = read_script_file(read_file(path, 1u << 24).value_or(""));
    return loaded;
}

/// One case in one configuration, or, without a case, the check of a file's notation.
class ScriptTest : public ::testing::Test {
public:
    ScriptTest(std::shared_ptr<const LoadedScripts> scripts, const ScriptCase* script,
               Configuration configuration)
        : scripts_(std::move(scripts)), script_(script), configuration_(configuration) {}

    void TestBody() override {
        for (const std::string& error : scripts_->file.errors) {
            ADD_FAILURE() << scripts_->path.string() << ":" << error;
        }
        if (!script_) return;
        for (const std::string& error :
             check_script(scripts_->file, *script_, scripts_->path.parent_path(), configuration_)) {
            ADD_FAILURE() << scripts_->path.string() << " " << script_->name << "\n" << error;
        }
    }

private:
    std::shared_ptr<const LoadedScripts> scripts_;
    const ScriptCase* script_;
    Configuration configuration_;
};

void register_test(const std::shared_ptr<const LoadedScripts>& scripts, const std::string& name,
                   const ScriptCase* script, const Configuration& configuration) {
    const fs::path suite = fs::relative(scripts->path, scripts_folder).replace_extension();
    ::testing::RegisterTest(suite.c_str(), name.c_str(), nullptr, nullptr, scripts->path.c_str(), 1,
                            [=] { return new ScriptTest(scripts, script, configuration); });
}

bool register_all() {
    for (const fs::path& path : scripts_below(scripts_folder)) {
        if (path.parent_path().filename() == "wrong") continue;
        const auto scripts = load(path);
        if (!scripts->file.errors.empty()) {
            register_test(scripts, "notation", nullptr, {});
            continue;
        }
        for (const ScriptCase& each : scripts->file.cases) {
            const std::string prefix = each.name.empty() ? "" : each.name + "/";
            for (const Configuration& configuration : configurations_of(each)) {
                register_test(scripts,
                              prefix + (each.is_only_checked() ? "check" : configuration.name()),
                              &each, configuration);
            }
        }
    }
    return true;
}

const bool are_registered = register_all();

TEST(Scripts, AreThere) {
    EXPECT_TRUE(are_registered);
    EXPECT_GT(scripts_below(scripts_folder).size(), 10u);
}

/// The first line of each file is the expected message, after "# ".
TEST(Scripts, ThatAreWrongFail) {
    const auto wrong = scripts_below(scripts_folder / "wrong");
    EXPECT_GT(wrong.size(), 10u);
    for (const fs::path& path : wrong) {
        const std::string text = read_file(path, 1u << 24).value_or("");
        ASSERT_TRUE(text.starts_with("# ")) << path;
        const std::string pattern = text.substr(2, text.find('\n') - 2);
        const auto scripts = load(path);
        std::vector<std::string> errors = scripts->file.errors;
        for (const ScriptCase& each : scripts->file.cases) {
            if (!errors.empty()) break;
            errors = check_script(scripts->file, each, path.parent_path(), {});
        }
        EXPECT_EQ(errors.size(), 1u) << path << ::testing::PrintToString(errors);
        for (const std::string& error : errors) {
            EXPECT_TRUE(matches(error, pattern)) << path << ": " << error;
        }
    }
}

TEST(Scripts, PatternsMatchWholeTexts) {
    EXPECT_TRUE(matches("a b", "a b"));
    EXPECT_TRUE(matches("add u: …", "add u: …"));
    EXPECT_TRUE(matches("a b a b c", "… b …c"));
    EXPECT_TRUE(matches("", "…"));
    EXPECT_FALSE(matches("a b", "a"));
    EXPECT_FALSE(matches("a b", "…a"));
    EXPECT_FALSE(matches("aba", "ab…ba"));
}

}  // namespace
}  // namespace cascade::test
