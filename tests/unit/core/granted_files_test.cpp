// Files that other files name are opened below granted folders and nowhere else.
#include "core/granted_files.h"
#include "core/open_below.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

namespace cascade {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class GrantedFilesTest : public testing::Test {
protected:
    void SetUp() override {
        root_ = fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(root_);
        fs::create_directories(root_ / "own/sub");
        fs::create_directories(root_ / "other/deep");
        for (const char* file : {"own/a", "own/sub/b", "other/c", "other/deep/d", "secret"}) {
            std::ofstream(root_ / file) << file;
        }
    }
    void TearDown() override { fs::remove_all(root_); }

    /// The content of the file, or the message.
    std::string outcome(const std::string& name, const ReadAccess& access = {}) const {
        const auto bytes = GrantedFiles(root_ / "own", access).read(name, 100);
        return bytes ? *bytes : bytes.error().message;
    }
    /// Expects that a file outside of the folders is refused, whether or not the file exists.
    void expect_outside(const std::string& name) const {
        EXPECT_EQ(outcome(name), "'" + name + "' lies outside of the script's folder");
    }

    fs::path root_;
};

TEST_F(GrantedFilesTest, ReadsWhatLiesBelowTheFolder) {
    EXPECT_EQ(outcome("a"), "own/a");
    EXPECT_EQ(outcome("sub/../sub/b"), "own/sub/b");
    EXPECT_EQ(outcome((root_ / "own/a").string()), "own/a");
    EXPECT_THAT(outcome("none"), HasSubstr("cannot read 'none': No such file"));
    EXPECT_THAT(outcome("sub"), HasSubstr("Is a directory"));
    EXPECT_THAT(outcome(""), HasSubstr("has a name"));
    EXPECT_THAT(outcome(std::string("a\0b", 3)), HasSubstr("NUL"));
}

TEST_F(GrantedFilesTest, RefusesWhatLiesOutsideWhetherItIsThereOrNot) {
    for (const char* name : {"../secret", "../none", "sub/../../secret", "/etc/hostname", "/none",
                             "../own/../secret", "../ownership"}) {
        expect_outside(name);
    }
}

TEST_F(GrantedFilesTest, FollowsLinksThatStayBelow) {
    fs::create_symlink("sub/b", root_ / "own/inside");
    fs::create_symlink(root_ / "own/sub", root_ / "own/absolute");
    fs::create_symlink("../secret", root_ / "own/outside");
    fs::create_symlink("../other", root_ / "own/folder");
    fs::create_symlink("loop", root_ / "own/loop");
    EXPECT_EQ(outcome("inside"), "own/sub/b");
    EXPECT_EQ(outcome("absolute/b"), "own/sub/b");
    expect_outside("outside");
    expect_outside("folder/c");
    EXPECT_THAT(outcome("loop"), HasSubstr("Too many levels of symbolic links"));
}

TEST_F(GrantedFilesTest, LooksInGrantedFoldersToo) {
    ReadAccess access;
    access.folders = {root_ / "other"};
    EXPECT_EQ(outcome("../other/c", access), "other/c");
    // In a granted folder a file is found by its whole name and by its last part, if the own folder
    // lacks it.
    EXPECT_EQ(outcome("c", access), "other/c");
    EXPECT_EQ(outcome("deep/d", access), "other/deep/d");
    EXPECT_EQ(outcome("models/c", access), "other/c");
    EXPECT_EQ(outcome("a", access), "own/a");
    EXPECT_THAT(outcome("../secret", access), HasSubstr("lies outside"));
    EXPECT_THAT(outcome("none", access), HasSubstr("No such file"));
    access.everything = true;
    EXPECT_EQ(outcome("../secret", access), "secret");
}

TEST_F(GrantedFilesTest, NamesInAFileAreRelativeToIt) {
    const GrantedFiles files = GrantedFiles(root_ / "own", {}).beside("sub/model");
    EXPECT_EQ(files.read("b", 100).value_or(""), "own/sub/b");
    EXPECT_EQ(files.read("../a", 100).value_or(""), "own/a");
    EXPECT_FALSE(files.read("../../secret", 100));
    EXPECT_FALSE(GrantedFiles::none().read("a", 100));
}

TEST_F(GrantedFilesTest, TellsWhyANameCannotBeUsed) {
    const std::string message = outcome(std::string(5000, 'x'));
    EXPECT_THAT(message, HasSubstr("File name too long"));
    EXPECT_LT(message.size(), 300U);
    EXPECT_LT(outcome("../" + std::string(200, 'x') + "/" + std::string(200, 'y')).size(), 300U);
    // A pipe is refused without waiting.
    ASSERT_EQ(::mkfifo((root_ / "own/pipe").c_str(), 0600), 0);
    EXPECT_EQ(outcome("pipe"), "'pipe' is a pipe or a device, not a file");
    ReadAccess all;
    all.everything = true;
    EXPECT_EQ(outcome("pipe", all), "'pipe' is a pipe or a device, not a file");
    EXPECT_EQ(outcome("/dev/zero", all), "'/dev/zero' is a pipe or a device, not a file");
}

TEST_F(GrantedFilesTest, OpensWithoutLeavingTheFolder) {
    fs::create_symlink("b", root_ / "own/sub/link");
    fs::create_symlink("sub", root_ / "own/folder");
    const Descriptor folder(::open((root_ / "own").c_str(), O_PATH | O_DIRECTORY));
    for (const PathWalk walk : {PathWalk::kernel_or_parts, PathWalk::parts}) {
        const auto error_of = [&](const fs::path& file) {
            const int number = open_below(folder, file, walk);
            const Descriptor opened(number);
            return number < 0 ? -number : 0;
        };
        EXPECT_EQ(error_of("a"), 0);
        EXPECT_EQ(error_of("sub/b"), 0);
        EXPECT_EQ(error_of("sub/none"), ENOENT);
        EXPECT_EQ(error_of("a/b"), ENOTDIR);
        EXPECT_EQ(error_of("sub/link"), ELOOP);
        EXPECT_NE(error_of("folder/b"), 0);
        EXPECT_EQ(error_of("../secret"), EXDEV);
        EXPECT_EQ(error_of("sub/../../secret"), EXDEV);
        EXPECT_EQ(error_of(root_ / "secret"), EXDEV);
        EXPECT_EQ(error_of(""), EXDEV);
    }
}

}  // namespace
}  // namespace cascade
