// Compiled kernels on disk are found again with the same bits, and damaged or foreign files do no
// harm.
#include "core/hash.h"
#include "ir/builder.h"
#include "jit/code_cache.h"
#include "jit/generator.h"
#include "jit/jit.h"
#include "jit/kernel_key.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/random_kernels.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <thread>

namespace cascade::test {
namespace {

namespace fs = std::filesystem;

/// A folder that is removed after the test.
class CacheTest : public ::testing::Test {
protected:
    CacheTest() {
        std::string pattern = (fs::temp_directory_path() / "cascade-cache-XXXXXX").string();
        EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
        outside_ = pattern;
        folder_ = outside_ / "kernels";
    }
    void SetUp() override {
        if (environment_key(2).empty()) GTEST_SKIP() << "nothing is kept for this processor";
    }
    ~CacheTest() override { fs::remove_all(outside_); }

    std::vector<fs::path> files() const {
        std::vector<fs::path> files;
        if (!fs::exists(folder_)) return files;
        for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
        return files;
    }
    fs::path only_file() const {
        EXPECT_EQ(files().size(), 1u);
        return files().empty() ? fs::path() : files()[0];
    }
    static std::string read(const fs::path& path) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }
    static void write(const fs::path& path, const std::string& bytes) {
        std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    }

    fs::path outside_, folder_;
};

const Grid small_grid{37, 5, Boundary::periodic};

CellKernel some_kernel(std::uint64_t seed) {
    RandomKernelOptions options;
    options.operations = 60;
    return random_kernel(seed, options);
}

std::unique_ptr<Backend> jit_with(const fs::path& folder) {
    auto made = make_jit({0, 2, folder});
    EXPECT_TRUE(made);
    return std::move(*made);
}

CodeImage some_image() { return {std::string("some code that nobody runs\0\1\2", 29), 3}; }

TEST_F(CacheTest, ResultsAreTheSameWithoutWithAndFromTheCache) {
    const auto without = jit_with("");
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const CellKernel kernel = some_kernel(seed);
        const auto expected = run_kernel(*without, kernel, small_grid, seed);
        EXPECT_EQ(same_bits(expected, run_kernel(*jit_with(folder_), kernel, small_grid, seed)),
                  "");
        EXPECT_EQ(files().size(), seed);
        EXPECT_EQ(same_bits(expected, run_kernel(*jit_with(folder_), kernel, small_grid, seed)),
                  "");
        EXPECT_EQ(files().size(), seed);
    }
}

TEST_F(CacheTest, WhatWasKeptIsWhatRuns) {
    // An image of another kernel under this kernel's key: the results show that the image was used.
    const CellKernel kernel = some_kernel(1);
    run_kernel(*jit_with(folder_), kernel, small_grid, 1);
    const std::string key = environment_key(2) + kernel_key(kernel, {Stencil::plane, 0});
    EXPECT_FALSE(CodeCache(folder_).find(key)) << "lanes are part of the key";
    std::optional<CodeImage> found;
    for (const int lanes : {4, 8, 16}) {
        const auto image = CodeCache(folder_).find(environment_key(2) +
                                                   kernel_key(kernel, {Stencil::plane, lanes}));
        EXPECT_FALSE(found && image);
        if (image) found = image;
    }
    ASSERT_TRUE(found);
    EXPECT_GT(found->bytes.size(), 100u);
}

TEST_F(CacheTest, KeysDifferInAllThatDecidesTheCode) {
    const CellKernel kernel = some_kernel(1);
    const std::string key = kernel_key(kernel, {Stencil::plane, 16});
    EXPECT_NE(key, kernel_key(kernel, {Stencil::row, 16}));
    EXPECT_NE(key, kernel_key(kernel, {Stencil::plane, 8}));
    EXPECT_NE(key, kernel_key(some_kernel(2), {Stencil::plane, 16}));
    CellKernel other = kernel;
    other.precision = Precision::binary64;
    EXPECT_NE(key, kernel_key(other, {Stencil::plane, 16}));
    other = kernel;
    other.results.push_back(other.results[0]);
    EXPECT_NE(key, kernel_key(other, {Stencil::plane, 16}));
    other = kernel;
    other.code.back().payload ^= 1;
    EXPECT_NE(key, kernel_key(other, {Stencil::plane, 16}));
    other = kernel;
    other.field_names[FieldSlot(0)] += "x";
    EXPECT_EQ(key, kernel_key(other, {Stencil::plane, 16})) << "names decide nothing";
    EXPECT_NE(environment_key(2), environment_key(0));
}

TEST_F(CacheTest, FoldersAndFilesAreTheUsersAlone) {
    CodeCache cache(folder_ / "deep" / "deeper");
    cache.keep("key", some_image());
    struct stat status {};
    ASSERT_EQ(::stat((folder_ / "deep" / "deeper").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 0700u);
    for (const auto& entry : fs::directory_iterator(folder_ / "deep" / "deeper")) {
        ASSERT_EQ(::stat(entry.path().c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 07777, 0600u);
    }
    EXPECT_TRUE(cache.find("key"));
}

TEST_F(CacheTest, WhatOthersMayWriteToIsNotRead) {
    CodeCache cache(folder_);
    cache.keep("key", some_image());
    const fs::path file = only_file();
    ASSERT_TRUE(cache.find("key"));
    for (const mode_t mode : {0620u, 0602u, 0666u}) {
        ASSERT_EQ(::chmod(file.c_str(), mode), 0);
        EXPECT_FALSE(cache.find("key"));
    }
    ASSERT_EQ(::chmod(file.c_str(), 0644), 0);
    EXPECT_TRUE(cache.find("key"));
    for (const mode_t mode : {0720u, 0702u, 0777u, 01777u}) {
        ASSERT_EQ(::chmod(folder_.c_str(), mode), 0);
        EXPECT_FALSE(cache.find("key"));
        cache.keep("other", some_image());
        EXPECT_EQ(files().size(), 1u);
    }
    ASSERT_EQ(::chmod(folder_.c_str(), 0700), 0);
    EXPECT_TRUE(cache.find("key"));
    if (::geteuid() == 0) {
        ASSERT_EQ(::chown(file.c_str(), 1, 1), 0);
        EXPECT_FALSE(cache.find("key")) << "a file of another user";
        ASSERT_EQ(::chown(file.c_str(), 0, 0), 0);
        ASSERT_EQ(::chown(folder_.c_str(), 1, 1), 0);
        EXPECT_FALSE(cache.find("key")) << "a folder of another user";
        ASSERT_EQ(::chown(folder_.c_str(), 0, 0), 0);
    }
    fs::rename(file, outside_ / "elsewhere");
    fs::create_symlink(outside_ / "elsewhere", file);
    EXPECT_FALSE(cache.find("key")) << "a link to a file";
    fs::create_directory_symlink(folder_, outside_ / "link");
    EXPECT_FALSE(CodeCache(outside_ / "link").find("key")) << "a link to a folder";
}

TEST_F(CacheTest, EveryDamagedByteAndEveryLengthIsNoticed) {
    CodeCache cache(folder_);
    cache.keep("a key", some_image());
    const fs::path file = only_file();
    const std::string whole = read(file);
    for (std::size_t n = 0; n < whole.size(); ++n) {
        for (const int bit : {0, 3, 7}) {
            std::string damaged = whole;
            damaged[n] = static_cast<char>(damaged[n] ^ (1 << bit));
            write(file, damaged);
            EXPECT_FALSE(cache.find("a key")) << "byte " << n << " bit " << bit;
        }
        write(file, whole.substr(0, n));
        EXPECT_FALSE(cache.find("a key")) << n << " bytes";
    }
    write(file, whole + '\0');
    EXPECT_FALSE(cache.find("a key"));
    write(file, whole);
    const auto found = cache.find("a key");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->bytes, some_image().bytes);
    EXPECT_EQ(found->entry, some_image().entry);
    // A file of another key, as if both keys had the same hash.
    cache.keep("another key", some_image());
    write(file, read(files()[0] == file ? files()[1] : files()[0]));
    EXPECT_FALSE(cache.find("a key"));
}

TEST_F(CacheTest, DamagedKernelsAreCompiledAgain) {
    const CellKernel kernel = some_kernel(3);
    const auto expected = run_kernel(*jit_with(folder_), kernel, small_grid, 3);
    const fs::path file = only_file();
    const std::string whole = read(file);
    for (std::uint32_t k = 0; k < 40; ++k) {
        const auto random = pcg4d({k, 1, 2, 3});
        std::string damaged = whole;
        if (k % 4 == 0) {
            damaged.resize(random[0] % damaged.size());
        } else {
            damaged[random[0] % damaged.size()] ^= static_cast<char>(1 + random[1] % 255);
        }
        write(file, damaged);
        EXPECT_EQ(same_bits(expected, run_kernel(*jit_with(folder_), kernel, small_grid, 3)), "");
        EXPECT_EQ(read(file), whole) << "written again";
    }
}

TEST_F(CacheTest, FoldersThatCannotBeMadeAreNoCache) {
    const CellKernel kernel = some_kernel(4);
    const auto expected = run_kernel(*jit_with(""), kernel, small_grid, 4);
    write(outside_ / "file", "no folder");
    EXPECT_EQ(same_bits(expected, run_kernel(*jit_with(outside_ / "file"), kernel, small_grid, 4)),
              "");
    EXPECT_EQ(same_bits(expected,
                        run_kernel(*jit_with(outside_ / "file/x/y"), kernel, small_grid, 4)),
              "");
    EXPECT_EQ(same_bits(expected, run_kernel(*jit_with("/proc/no/such"), kernel, small_grid, 4)),
              "");
}

TEST_F(CacheTest, TheOldestGoWhereThereIsNoRoom) {
    const std::string large(1000, 'x');
    for (int k = 0; k < 20; ++k) {
        CodeCache(folder_, 1 << 20).keep(std::to_string(k), {large, 0});
        // Times of files are coarse, so each file is made a minute younger than the previous one.
        for (const fs::path& file : files()) {
            fs::last_write_time(file, fs::last_write_time(file) - std::chrono::minutes(1));
        }
    }
    EXPECT_EQ(files().size(), 20u);
    CodeCache small(folder_, 10500);
    small.keep("new", {large, 0});
    EXPECT_LT(files().size(), 12u);
    EXPECT_FALSE(small.find("0"));
    EXPECT_TRUE(small.find("19"));
    EXPECT_TRUE(small.find("new"));
}

TEST_F(CacheTest, WhatKilledProcessesLeftIsRemoved) {
    CodeCache(folder_).keep("key", some_image());
    const std::string dead = ".cascade-" + std::string(32, '1') + ".tmp";
    const std::string young = ".cascade-" + std::string(32, '2') + ".tmp";
    write(folder_ / dead, "half");
    write(folder_ / young, "just begun by another process");
    fs::last_write_time(folder_ / dead, fs::file_time_type::clock::now() - std::chrono::hours(2));
    CodeCache(folder_).keep("another key", some_image());
    EXPECT_FALSE(fs::exists(folder_ / dead));
    EXPECT_TRUE(fs::exists(folder_ / young));
}

TEST_F(CacheTest, NothingIsRemovedButWhatWasKeptHere) {
    // Files of other programs and other caches in a folder that CASCADE_KERNEL_CACHE names.
    fs::create_directories(folder_);
    fs::permissions(folder_, fs::perms::owner_all);
    const std::string digits(32, 'a');
    const std::vector<std::string> others = {"notes.new",        "app.conf.new",  "my.kernel",
                                             digits + ".kernel", digits + ".new", "1-2-3.tmp"};
    for (const std::string& name : others) {
        write(folder_ / name, std::string(20000, 'x'));
        fs::last_write_time(folder_ / name,
                            fs::file_time_type::clock::now() - std::chrono::hours(2));
    }
    for (int k = 0; k < 20; ++k)
        CodeCache(folder_, 5000).keep(std::to_string(k), {std::string(1000, 'x'), 0});
    for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
    EXPECT_LT(files().size(), others.size() + 20);
}

TEST_F(CacheTest, ProcessesMayShareAFolder) {
    std::vector<pid_t> children;
    for (int child = 0; child < 4; ++child) {
        const pid_t pid = ::fork();
        ASSERT_GE(pid, 0);
        if (pid == 0) {
            // So small that the processes remove each other's files.
            CodeCache cache(folder_, 20000);
            for (int n = 0; n < 500; ++n) {
                const std::string key = std::to_string(n % 50);
                const std::string bytes(500 + static_cast<std::size_t>(n % 50), 'y');
                cache.keep(key, {bytes, 1});
                const auto found = cache.find(key);
                if (found && found->bytes != bytes) ::_exit(1);
            }
            ::_exit(0);
        }
        children.push_back(pid);
    }
    for (const pid_t child : children) {
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_EQ(status, 0);
    }
    for (const fs::path& file : files()) EXPECT_EQ(file.extension(), ".kernel");
}

TEST_F(CacheTest, ThreadsMayShareABackend) {
    const auto jit = jit_with(folder_);
    std::vector<std::thread> threads;
    std::vector<KernelPointer> kernels(8);
    for (std::size_t t = 0; t < kernels.size(); ++t) {
        threads.emplace_back([&, t] {
            const auto made = jit->compile(some_kernel(1 + t % 2), Stencil::plane);
            if (made) kernels[t] = *made;
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t t = 0; t < kernels.size(); ++t) {
        ASSERT_TRUE(kernels[t]);
        EXPECT_EQ(kernels[t], kernels[t % 2]) << "each is compiled once";
    }
    EXPECT_EQ(files().size(), 2u);
}

}  // namespace
}  // namespace cascade::test
