// The caches of a machine as described by a folder, and the share of one thread.
#include "core/cache_sizes.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>
#include <vector>

namespace cascade::test {
namespace {

/// A folder like the one in which Linux describes the caches of a processor.
class CacheFolder {
public:
    CacheFolder()
        : path_(std::filesystem::path(::testing::TempDir()) /
                ("caches_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~CacheFolder() { std::filesystem::remove_all(path_); }
    void add(int index, const std::string& level, const std::string& type, const std::string& size,
             const std::string& shared) const {
        const auto folder = path_ / ("index" + std::to_string(index));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "level") << level << '\n';
        std::ofstream(folder / "type") << type << '\n';
        std::ofstream(folder / "size") << size << '\n';
        std::ofstream(folder / "shared_cpu_list") << shared << '\n';
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

TEST(CacheSizes, AreThoseOfOneThread) {
    const CacheFolder folder;
    folder.add(0, "1", "Data", "32K", "0");
    folder.add(1, "2", "Unified", "2048K", "0-1");
    folder.add(2, "3", "Unified", "64M", "0-3,8,10-12");
    const CacheSizes sizes = CacheSizes::described_in(folder.path());
    EXPECT_EQ(sizes.second, 1 << 20);
    EXPECT_EQ(sizes.third, 8 << 20);
}

TEST(CacheSizes, StayAsTheyAreWhereNothingIsSaid) {
    const CacheSizes usual;
    const CacheFolder folder;
    EXPECT_EQ(CacheSizes::described_in(folder.path()).second, usual.second);
    folder.add(0, "2", "Unified", "many", "0-");
    folder.add(1, "3", "Unified", "-5K", "");
    EXPECT_EQ(CacheSizes::described_in(folder.path()).second, usual.second);
    EXPECT_EQ(CacheSizes::described_in(folder.path()).third, usual.third);
}

TEST(CacheLevels, AreThoseOfDataNearestFirst) {
    const CacheFolder folder;
    folder.add(0, "1", "Data", "32K", "0");
    folder.add(1, "1", "Instruction", "64K", "0");
    folder.add(2, "3", "Unified", "1G", "0-7");
    folder.add(3, "2", "Unified", "1024K", "0-1");
    folder.add(4, "4", "Unified", "nonsense", "0-1");
    folder.add(5, "inclusive", "Unified", "8M", "0");
    const std::vector<CacheLevel> expected = {{1, 32 << 10, 1}, {2, 1 << 20, 2}, {3, 1 << 30, 8}};
    EXPECT_EQ(cache_levels(folder.path()), expected);
    EXPECT_TRUE(cache_levels(folder.path() / "nowhere").empty());
}

}  // namespace
}  // namespace cascade::test
