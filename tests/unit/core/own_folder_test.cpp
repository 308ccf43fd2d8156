#include "core/own_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace cascade {
namespace {

namespace fs = std::filesystem;

TEST(OwnFolder, FoldersAreNotMadeWhereAnotherUserIsAtHome) {
    std::string pattern = (fs::temp_directory_path() / "cascade-home-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    const fs::path home = pattern;
    EXPECT_TRUE(may_keep_files_in(home));
    EXPECT_TRUE(may_keep_files_in(home / ".cache/cascade/kernels"));
    EXPECT_TRUE(may_keep_files_in("/no/such/folder")) << "the system's own";
    if (::geteuid() == 0) {
        ASSERT_EQ(::chown(home.c_str(), 1, 1), 0);
        EXPECT_FALSE(may_keep_files_in(home));
        EXPECT_FALSE(may_keep_files_in(home / ".cache/cascade/kernels"));
        ASSERT_EQ(::chown(home.c_str(), 0, 0), 0);
    }
    fs::remove_all(home);
}

}  // namespace
}  // namespace cascade
