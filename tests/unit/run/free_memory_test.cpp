// The memory that is available in containers, read from test folders laid out like /proc and /sys.
#include "run/domain/free_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace cascade {
namespace {

namespace fs = std::filesystem;

class FreeMemory : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "cascade-memory-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        root_ = pattern;
        write("proc/meminfo",
              "MemTotal:       16000 kB\nMemFree:         1000 kB\nMemAvailable:    8000 kB\n");
    }
    void TearDown() override { fs::remove_all(root_); }

    void write(const std::string& path, const std::string& text) {
        fs::create_directories((root_ / path).parent_path());
        std::ofstream(root_ / path) << text;
    }
    void group(const std::string& path, const std::string& limit, const std::string& used) {
        write("sys/fs/cgroup" + path + "/memory.max", limit + "\n");
        write("sys/fs/cgroup" + path + "/memory.current", used + "\n");
    }

    fs::path root_;
};

constexpr std::uint64_t of_the_machine = 8000 * 1024;

TEST_F(FreeMemory, IsTheMachinesWhereNothingElseIsSaid) {
    EXPECT_EQ(available_memory(root_), of_the_machine);
    write("proc/self/cgroup", "0::/\n");
    EXPECT_EQ(available_memory(root_), of_the_machine);
    group("", "max", "5000000");
    EXPECT_EQ(available_memory(root_), of_the_machine);
    fs::remove(root_ / "proc/meminfo");
    EXPECT_EQ(available_memory(root_), 0u);
    EXPECT_GT(available_memory(), 0u) << "of this machine";
}

TEST_F(FreeMemory, AGroupAndThoseAboveItLimitIt) {
    write("proc/self/cgroup", "0::/outer/inner\n");
    group("/outer/inner", "max", "100000");
    EXPECT_EQ(available_memory(root_), of_the_machine);
    group("/outer", "3000000", "1000000");
    EXPECT_EQ(available_memory(root_), 2000000u);
    group("/outer/inner", "500000", "100000");
    EXPECT_EQ(available_memory(root_), 400000u);
    group("/outer/inner", "50000000", "100000");
    EXPECT_EQ(available_memory(root_), 2000000u);
    // Memory in which a group only caches files counts as available.
    write("sys/fs/cgroup/outer/memory.stat",
          "anon 500000\nfile 400000\ninactive_file 300000\nactive_file 100000\n");
    EXPECT_EQ(available_memory(root_), 2400000u);
    group("/outer", "1000000", "9000000");
    EXPECT_EQ(available_memory(root_), 1u)
        << "a full group has none, which is not the same as nobody knows";
}

TEST_F(FreeMemory, AContainersOwnGroupIsMountedAtTheTop) {
    write("proc/self/cgroup", "0::/system.slice/docker-7a.scope\n");
    group("", "4000000", "1000000");
    EXPECT_EQ(available_memory(root_), 3000000u);
    write("proc/self/cgroup", "0::/../../strange\n");
    EXPECT_EQ(available_memory(root_), 3000000u);
}

TEST_F(FreeMemory, Version1) {
    write("proc/self/cgroup", "12:cpu,cpuacct:/x\n5:memory:/docker/7a\n0::/\n");
    const std::string top = "sys/fs/cgroup/memory";
    write(top + "/docker/7a/memory.limit_in_bytes", "9223372036854771712\n");
    write(top + "/docker/7a/memory.usage_in_bytes", "1000000\n");
    EXPECT_EQ(available_memory(root_), of_the_machine);
    write(top + "/docker/memory.limit_in_bytes", "3000000\n");
    write(top + "/docker/memory.usage_in_bytes", "2000000\n");
    write(top + "/docker/memory.stat", "cache 5\ninactive_file 7\ntotal_inactive_file 500000\n");
    EXPECT_EQ(available_memory(root_), 1500000u);
}

TEST_F(FreeMemory, NonsenseIsNoLimit) {
    write("proc/self/cgroup", "nonsense\n::\n0::\n\n");
    group("", "lots", "");
    EXPECT_EQ(available_memory(root_), of_the_machine);
}

}  // namespace
}  // namespace cascade
