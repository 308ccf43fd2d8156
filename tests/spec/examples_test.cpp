// The example scripts are sound: no messages, and kernels that can be verified.
#include "core/file.h"
#include "run/script/script.h"
#include "tests/spec/sound_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace cascade {
namespace {

const std::filesystem::path examples_folder =
    std::filesystem::path(CASCADE_SOURCE_DIR) / "examples";

std::vector<std::filesystem::path> examples() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(examples_folder)) {
        if (entry.path().extension() == ".cascade") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

class ExampleTest : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ExampleTest, PassesWithoutAMessage) {
    auto file = load_script_file(GetParam());
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->script.messages(false), "");
    ASSERT_TRUE(file->script.program);
    EXPECT_TRUE(file->script.text.starts_with("# ")) << "an example begins with what it is";
    expect_sound_kernels(*file->script.program);
}

TEST_P(ExampleTest, IsInTheList) {
    const auto list = read_file(examples_folder / "README.md", 1u << 20);
    ASSERT_TRUE(list);
    EXPECT_NE(list->find("`" + GetParam().stem().string() + "`"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Scripts, ExampleTest, testing::ValuesIn(examples()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

}  // namespace
}  // namespace cascade
