// Typed lines are written to the file at once, and are read again unchanged.
#include "app/history_file.h"

#include "core/file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace cascade {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

class HistoryFiles : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "cascade-history-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        path_ = folder_ / "state" / "history";
    }
    void TearDown() override { fs::remove_all(folder_); }

    Lines loaded() const { return HistoryFile(path_).load(); }
    void write(const std::string& text) {
        fs::create_directories(path_.parent_path());
        ASSERT_TRUE(write_file(path_, text));
    }

    fs::path folder_, path_;
};

TEST_F(HistoryFiles, EachLineIsThereAtOnce) {
    HistoryFile file(path_);
    EXPECT_EQ(file.load(), Lines{});
    Lines typed = {"stage s: turing_spots { ka: 1/80 }", "  a\\b\t'\"", ":run 20", "∇²u = \x01\xff",
                   "\\101"};
    for (std::size_t k = 0; k < typed.size(); ++k) {
        file.add(typed[k]);
        EXPECT_EQ(loaded(),
                  Lines(typed.begin(), typed.begin() + static_cast<std::ptrdiff_t>(k) + 1));
    }
    HistoryFile other(path_);  // Another prompt that runs at the same time.
    other.add("from elsewhere");
    file.add("and here");
    typed.insert(typed.end(), {"from elsewhere", "and here"});
    EXPECT_EQ(loaded(), typed);
    EXPECT_EQ(fs::status(path_).permissions() & fs::perms::all,
              fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(HistoryFiles, FilesOfLibeditAreRead) {
    write("_HiStOrY_V2_\nstage\\040s:\\040turing_spots\n:run\\04020\na\\\\b\\134c\n\n");
    EXPECT_EQ(loaded(), (Lines{"stage s: turing_spots", ":run 20", "a\\b\\c"}));
}

TEST_F(HistoryFiles, ALineThatWasCutOffSpoilsNoOther) {
    write("_HiStOrY_V2_\nwhole\nhal");
    HistoryFile file(path_);
    EXPECT_EQ(file.load(), (Lines{"whole", "hal"}));
    file.add("next");
    EXPECT_EQ(loaded(), (Lines{"whole", "hal", "next"}));
    write("");
    EXPECT_EQ(loaded(), Lines{});
    write("\\");
    EXPECT_EQ(loaded(), Lines{"\\"});
}

TEST_F(HistoryFiles, ALineIsKeptOnceAndTheFileStaysShort) {
    std::string text = "_HiStOrY_V2_\n";
    for (int k = 0; k < 5000; ++k) text += k % 2 == 0 ? ":run\n" : std::to_string(k) + "\n";
    write(text);
    const Lines lines = loaded();
    EXPECT_EQ(lines.size(), HistoryFile::most_lines);
    EXPECT_EQ(lines.back(), "4999");
    EXPECT_EQ(lines[lines.size() - 2], ":run");
    EXPECT_LT(fs::file_size(path_), text.size());
    EXPECT_EQ(loaded(), lines);
}

TEST_F(HistoryFiles, WhereNothingCanBeKeptNothingIs) {
    HistoryFile("").add("x");
    HistoryFile(folder_).add("x");
    HistoryFile("/proc/none/history").add("x");
    EXPECT_EQ(HistoryFile(folder_).load(), Lines{});
    if (::geteuid() == 0) {
        const fs::path guest = folder_ / "guest";
        fs::create_directory(guest);
        ASSERT_EQ(::chown(guest.c_str(), 1, 1), 0);
        HistoryFile(guest / "state/history").add("x");
        EXPECT_TRUE(fs::is_empty(guest)) << "root leaves nothing in another user's home";
    }
}

}  // namespace
}  // namespace cascade
