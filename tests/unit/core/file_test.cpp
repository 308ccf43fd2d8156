// Reading and writing files.
#include "core/file.h"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cascade {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "cascade-file-test-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }

    static std::string content(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::size_t files_in_folder() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    static std::string message(const Result<void>& result) {
        return result ? "" : result.error().message;
    }

    fs::path folder_;
};

TEST_F(Files, WhatIsWrittenIsRead) {
    std::string bytes(300000, '\0');
    for (std::size_t n = 0; n < bytes.size(); ++n) bytes[n] = static_cast<char>(n * 31 % 251);
    const fs::path path = folder_ / "data.bin";
    ASSERT_TRUE(write_file(path, bytes));
    const auto read = read_file(path, 1 << 20);
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, bytes);
    ASSERT_TRUE(write_file(path, ""));
    EXPECT_EQ(*read_file(path, 0), "");
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(Files, ReadingHasALimit) {
    const fs::path path = folder_ / "large";
    std::ofstream(path) << std::string(100, 'x');
    EXPECT_TRUE(read_file(path, 100));
    const auto refused = read_file(path, 99);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("at most 99 bytes"), std::string::npos);
    // A device has no size, so the limit applies while reading.
    EXPECT_FALSE(read_file("/dev/zero", 1000));
    EXPECT_EQ(read_file("/dev/null", 1000).value(), "");
}

TEST_F(Files, WhatCannotBeReadSaysWhy) {
    const auto missing = read_file(folder_ / "missing", 10);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("missing': No such file"), std::string::npos);
    const auto folder = read_file(folder_, 10);
    ASSERT_FALSE(folder);
    EXPECT_NE(folder.error().message.find("directory"), std::string::npos);
    if (::geteuid() != 0) {
        const fs::path secret = folder_ / "secret";
        std::ofstream(secret) << "x";
        fs::permissions(secret, fs::perms::none);
        EXPECT_FALSE(read_file(secret, 10));
    }
}

TEST_F(Files, APlainFileIsNoLinkNoPipeAndNoDevice) {
    std::ofstream(folder_ / "plain") << "text";
    EXPECT_EQ(read_plain_file(folder_ / "plain", 10).value(), "text");
    EXPECT_FALSE(read_plain_file(folder_ / "plain", 3));
    fs::create_symlink("plain", folder_ / "link");
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    for (const fs::path& path :
         {folder_ / "link", folder_ / "pipe", fs::path("/dev/zero"), folder_}) {
        EXPECT_FALSE(read_plain_file(path, 10)) << path;
    }
    EXPECT_NE(read_plain_file(folder_ / "pipe", 10)
                  .error()
                  .message.find("a pipe or a device, not a file"),
              std::string::npos);
}

TEST_F(Files, AWriteReplacesAndKeepsPermissions) {
    const fs::path path = folder_ / "picture.png";
    std::ofstream(path) << "old and longer";
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    ASSERT_TRUE(write_file(path, "new"));
    EXPECT_EQ(content(path), "new");
    EXPECT_EQ(static_cast<unsigned>(fs::status(path).permissions()), 0640u);

    const mode_t mask = ::umask(027);
    ASSERT_TRUE(write_file(folder_ / "fresh", "x"));
    ::umask(mask);
    EXPECT_EQ(static_cast<unsigned>(fs::status(folder_ / "fresh").permissions()), 0640u);
}

TEST_F(Files, AWriteGoesThroughLinks) {
    const fs::path real = folder_ / "real", link = folder_ / "link";
    std::ofstream(real) << "old";
    fs::create_symlink("real", link);
    EXPECT_TRUE(check_writable(link));
    ASSERT_TRUE(write_file(link, "new"));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(content(real), "new");

    const fs::path dangling = folder_ / "dangling";
    fs::create_symlink("made", dangling);
    ASSERT_TRUE(write_file(dangling, "through"));
    EXPECT_EQ(content(folder_ / "made"), "through");
}

TEST_F(Files, ADeviceIsWrittenNotReplaced) {
    EXPECT_TRUE(check_writable("/dev/null"));
    EXPECT_TRUE(write_file("/dev/null", "x"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Files, AFullDiskIsAFailure) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    const auto full = write_file("/dev/full", "x");
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("No space left"), std::string::npos);
    EXPECT_FALSE(full.error().hint.empty());
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Files, AFailedWriteLeavesTheOldFileAndNothingElse) {
    const fs::path path = folder_ / "kept";
    ASSERT_TRUE(write_file(path, "old"));
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto refused = write_file(path, std::string(1'000'000, 'x'));
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("kept"), std::string::npos);
    EXPECT_EQ(content(path), "old");
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(Files, WhereNoFileCanBe) {
    std::ofstream(folder_ / "file") << "x";
    for (const fs::path& path :
         {folder_ / "no-folder" / "a.png", folder_ / "file" / "a.png", folder_,
          folder_ / std::string(300, 'n'), fs::path("/proc/a.png")}) {
        EXPECT_FALSE(check_writable(path)) << path;
        EXPECT_FALSE(write_file(path, "x")) << path;
    }
    EXPECT_NE(message(check_writable(folder_ / "no-folder" / "a.png")).find("no folder"),
              std::string::npos);
    EXPECT_FALSE(check_writable(""));
    EXPECT_FALSE(check_writable(folder_ / "file" / ""));
    EXPECT_EQ(files_in_folder(), 1u);
    if (::geteuid() != 0) {
        fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
        EXPECT_FALSE(check_writable(folder_ / "a.png"));
        fs::permissions(folder_, fs::perms::owner_all);
    }
}

TEST_F(Files, CheckingLeavesNothingBehind) {
    EXPECT_TRUE(check_writable(folder_ / "a.png"));
    EXPECT_TRUE(check_writable(folder_ / std::string(250, 'n')));
    EXPECT_EQ(files_in_folder(), 0u);
    std::ofstream(folder_ / "b.png") << "kept";
    EXPECT_TRUE(check_writable(folder_ / "b.png"));
    EXPECT_EQ(content(folder_ / "b.png"), "kept");
    EXPECT_EQ(files_in_folder(), 1u);
}

}  // namespace
}  // namespace cascade
