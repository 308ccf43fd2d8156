// Files that are written in parts.
#include "core/growing_file.h"

#include "core/file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <string>

namespace cascade {
namespace {

class GrowingFiles : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "cascade-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_),
                                                      std::filesystem::directory_iterator()));
    }

    std::filesystem::path folder_;
};

TEST_F(GrowingFiles, TakeTheirNameAtTheEnd) {
    const auto path = folder_ / "a.bin";
    auto file = GrowingFile::create(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE((*file)->append("0000 and "));
    ASSERT_TRUE((*file)->append("more"));
    EXPECT_EQ((*file)->size(), 13U);
    ASSERT_TRUE((*file)->overwrite(1, "123"));
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_EQ(*read_file((*file)->temporary_path(), 100), "0123 and more");
    ASSERT_TRUE((*file)->complete());
    EXPECT_EQ(*read_file(path, 100), "0123 and more");
    EXPECT_EQ(files(), 1U);
}

TEST_F(GrowingFiles, LeaveNothingBeforeTheyAreComplete) {
    const auto path = folder_ / "a.bin";
    ASSERT_TRUE(write_file(path, "old"));
    {
        auto file = GrowingFile::create(path);
        ASSERT_TRUE(file);
        ASSERT_TRUE((*file)->append("new"));
        EXPECT_EQ(files(), 2U);
    }
    EXPECT_EQ(*read_file(path, 100), "old");
    EXPECT_EQ(files(), 1U);
}

TEST_F(GrowingFiles, CanBeReadFromTheirFirstBytesOn) {
    const auto path = folder_ / "a.txt";
    {
        auto file = GrowingFile::create(path);
        ASSERT_TRUE(file);
        ASSERT_TRUE((*file)->append("[1]"));
        ASSERT_TRUE((*file)->appear());
        EXPECT_EQ(*read_file(path, 100), "[1]");
        ASSERT_TRUE((*file)->replace_end(2, ", 2]"));
        EXPECT_EQ((*file)->size(), 6U);
        EXPECT_EQ(*read_file(path, 100), "[1, 2]");
        ASSERT_TRUE((*file)->append("\n"));
    }
    EXPECT_EQ(*read_file(path, 100), "[1, 2]\n");
    EXPECT_EQ(files(), 1U);
}

TEST_F(GrowingFiles, ReplaceWhatALinkLeadsTo) {
    std::filesystem::create_directories(folder_ / "deep");
    ASSERT_TRUE(write_file(folder_ / "deep/a.bin", "old"));
    std::filesystem::permissions(folder_ / "deep/a.bin", std::filesystem::perms::owner_all);
    std::filesystem::create_symlink("deep/a.bin", folder_ / "link");
    auto file = GrowingFile::create(folder_ / "link");
    ASSERT_TRUE(file);
    ASSERT_TRUE((*file)->append("new"));
    ASSERT_TRUE((*file)->complete());
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
    EXPECT_EQ(*read_file(folder_ / "deep/a.bin", 100), "new");
    EXPECT_EQ(std::filesystem::status(folder_ / "deep/a.bin").permissions(),
              std::filesystem::perms::owner_all);
}

TEST_F(GrowingFiles, AreNoPipesOrFolders) {
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    auto pipe = GrowingFile::create(folder_ / "pipe");
    ASSERT_FALSE(pipe);
    EXPECT_NE(pipe.error().message.find("pipe"), std::string::npos);
    EXPECT_FALSE(GrowingFile::create(folder_));
    EXPECT_FALSE(GrowingFile::create(folder_ / "missing/a.bin"));
    EXPECT_EQ(files(), 1U);
}

TEST_F(GrowingFiles, SayThatTheDiskIsFull) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit usual{};
    getrlimit(RLIMIT_FSIZE, &usual);
    const rlimit small{1000, usual.rlim_max};
    const auto path = folder_ / "a.bin";
    {
        auto file = GrowingFile::create(path);
        ASSERT_TRUE(file);
        setrlimit(RLIMIT_FSIZE, &small);
        EXPECT_TRUE((*file)->append(std::string(900, 'x')));
        const auto full = (*file)->append(std::string(900, 'x'));
        EXPECT_FALSE((*file)->replace_end(800, std::string(300, 'y')));
        EXPECT_EQ(*read_file((*file)->temporary_path(), 2000), std::string(900, 'x'));
        setrlimit(RLIMIT_FSIZE, &usual);
        ASSERT_FALSE(full);
        EXPECT_NE(full.error().message.find("a.bin': File too large"), std::string::npos)
            << full.error().message;
    }
    EXPECT_EQ(files(), 0U);
}

}  // namespace
}  // namespace cascade
