// Temporary files: unique names, and removal of files of killed processes.
#include "core/temporary_file.h"

#include "core/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace cascade {
namespace {

namespace fs = std::filesystem;

class TemporaryFiles : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "cascade-temporary-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::set<std::string> names() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_))
            names.insert(entry.path().filename());
        return names;
    }
    void make_old(const fs::path& path) const {
        fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(2));
    }

    fs::path folder_;
};

TEST_F(TemporaryFiles, NamesAreNeverMetTwice) {
    std::set<std::string> digits;
    for (int k = 0; k < 1000; ++k) digits.insert(random_digits());
    EXPECT_EQ(digits.size(), 1000u);
    for (const std::string& each : digits)
        EXPECT_TRUE(is_temporary_name(".cascade-" + each + ".tmp"));
}

TEST_F(TemporaryFiles, NoOtherNameIsTaken) {
    const std::string digits(32, 'a');
    EXPECT_TRUE(is_temporary_name(".cascade-" + digits + ".tmp"));
    for (const char* name :
         {".cascade-1-0.tmp", ".cascade-.tmp", "a.tmp", ".cascade-aaaa.tmp", "", "notes.new"}) {
        EXPECT_FALSE(is_temporary_name(name)) << name;
    }
    EXPECT_FALSE(is_temporary_name(".cascade-" + digits + ".npy"));
    EXPECT_FALSE(is_temporary_name(".cascade-" + std::string(32, 'A') + ".tmp"));
    EXPECT_FALSE(is_temporary_name(".cascade-" + digits + "a.tmp"));
}

TEST_F(TemporaryFiles, IsGoneUnlessItGetsItsName) {
    const Descriptor folder(open_folder(folder_));
    { TemporaryFile dropped(folder); }
    EXPECT_TRUE(names().empty());
    {
        TemporaryFile file(folder, 0600);
        ASSERT_EQ(file.write("text"), 0);
        ASSERT_EQ(file.rename_to("named"), 0);
    }
    EXPECT_EQ(names(), std::set<std::string>{"named"});
    EXPECT_EQ(read_file(folder_ / "named", 10).value(), "text");
    const Descriptor none(open_folder(folder_ / "none"));
    TemporaryFile nowhere(none);
    EXPECT_NE(nowhere.error(), 0);
    EXPECT_NE(nowhere.write("x"), 0);
    EXPECT_NE(nowhere.rename_to("x"), 0);
}

TEST_F(TemporaryFiles, OnlyWhatIsCertainlyDeadIsRemoved) {
    const auto digits = [](char digit) { return ".cascade-" + std::string(32, digit) + ".tmp"; };
    // A file of a killed process, a file that is still being written, a recent one, and files of
    // other programs.
    for (const std::string& name : {digits('1'), digits('2'), digits('3')}) {
        std::ofstream(folder_ / name) << "half";
    }
    for (const char* other : {".cascade-1-0.tmp", "mine.tmp", ".cascade-mine.tmp"}) {
        std::ofstream(folder_ / other) << "whole";
        make_old(folder_ / other);
    }
    fs::create_symlink(folder_ / "mine.tmp", folder_ / digits('4'));
    fs::create_directory(folder_ / digits('5'));
    make_old(folder_ / digits('1'));
    make_old(folder_ / digits('2'));
    make_old(folder_ / digits('5'));
    const Descriptor writer(::open((folder_ / digits('2')).c_str(), O_RDWR | O_CLOEXEC));
    ASSERT_EQ(::flock(writer.number(), LOCK_EX), 0);
    remove_dead_temporaries(folder_);
    EXPECT_FALSE(names().contains(digits('1')));
    EXPECT_EQ(names().size(), 7u);
    remove_dead_temporaries(folder_ / "none");
}

TEST_F(TemporaryFiles, AFileThatIsWrittenIsLocked) {
    const Descriptor folder(open_folder(folder_));
    const TemporaryFile file(folder);
    make_old(folder_ / file.name());
    remove_dead_temporaries(folder_);
    EXPECT_TRUE(names().contains(file.name()));
}

TEST_F(TemporaryFiles, ManyProcessesOfOneNumberDoNotMeet) {
    // As for processes in two containers, only the system's random numbers make these names
    // different.
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([this, t] {
            for (int k = 0; k < 50; ++k) {
                EXPECT_TRUE(write_file(folder_ / std::to_string(k),
                                       std::string(100, static_cast<char>('a' + t))));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(names().size(), 50u);
}

TEST_F(TemporaryFiles, APipeThatNobodyReadsIsRefusedAtOnce) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const auto refused = write_file(pipe, "x");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("no program reads this pipe"), std::string::npos);
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(TemporaryFiles, APipeIsWrittenAsFastAsItIsRead) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const Descriptor reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    const std::string bytes(1'000'000, 'x');
    std::string read;
    std::thread writer([&] { EXPECT_TRUE(write_file(pipe, bytes)); });
    std::vector<char> piece(65536);
    while (read.size() < bytes.size()) {
        const ssize_t got = ::read(reader.number(), piece.data(), piece.size());
        if (got > 0) read.append(piece.data(), static_cast<std::size_t>(got));
        else std::this_thread::yield();
    }
    writer.join();
    EXPECT_EQ(read, bytes);
}

TEST_F(TemporaryFiles, ASignalEndsTheWaitForAReader) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const Descriptor reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    struct sigaction action = {}, before = {};
    action.sa_handler = [](int) {};
    action.sa_flags = SA_RESTART;  // As in the program's own handlers.
    ASSERT_EQ(::sigaction(SIGUSR1, &action, &before), 0);
    const pthread_t waiting = ::pthread_self();
    std::atomic<bool> is_over{false};
    std::thread interrupter([&] {
        while (!is_over) {
            ::pthread_kill(waiting, SIGUSR1);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    });
    EXPECT_FALSE(write_file(pipe, std::string(1'000'000, 'x')));
    is_over = true;
    interrupter.join();
    ::sigaction(SIGUSR1, &before, nullptr);
}

}  // namespace
}  // namespace cascade
