// Saved runs are replaced in one move and complete at every moment. Saving touches no other file,
// and a run whose files have changed is not resumed.
#include "core/descriptor.h"
#include "resumed_run.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

class SavedFolderTest : public ResumedRunTest {
protected:
    void save(const std::string& text, std::int64_t step, const Overrides& overrides = {}) {
        Script script = load(text, overrides);
        RunRequest wanted = request();
        wanted.save = path("saved");
        wanted.stop_at = StopAt{"large", step};
        run_well(script, wanted);
    }
    std::string why_not_saved(const std::string& text) {
        Script script = load(text);
        RunRequest wanted = request();
        wanted.save = path("saved");
        return run_badly(script, wanted);
    }
    /// Resumes to the end, and expects the bits of an uninterrupted run.
    void expect_resumable() {
        if (!fs::exists(path("whole"))) run_whole(two_stages);
        auto script = load_saved_script(path("saved"), {});
        ASSERT_TRUE(script);
        RunRequest wanted = request();
        wanted.resume = path("saved");
        wanted.save = path("rest");
        run_well(*script, wanted);
        for (const char* name : {"large.a.npy", "large.b.npy", "small.a.npy", "small.b.npy"}) {
            EXPECT_EQ(bytes(std::string("rest/") + name), bytes(std::string("whole/") + name))
                << name;
        }
    }
    std::string why_not_resumed() {
        auto script = load_saved_script(path("saved"), {});
        if (!script) return script.error().message;
        RunRequest wanted = request();
        wanted.resume = path("saved");
        return run_badly(*script, wanted);
    }
    std::set<std::string> names() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(path("saved")))
            names.insert(entry.path().filename());
        return names;
    }
    nlohmann::json manifest() const { return nlohmann::json::parse(bytes("saved/run.json")); }
};

TEST_F(SavedFolderTest, AKilledWriterHasCommittedTheNewRunOrHasNot) {
    save(two_stages, 70);
    const std::set<std::string> before = names();
    // A new run was not committed, and one of its files is left.
    const std::string unfinished = ".cascade-" + std::string(32, 'a') + ".npy";
    ASSERT_TRUE(write_file(path("saved/" + unfinished), "half of an array"));
    expect_resumable();
    // A new run was committed, but some or all of its files still have temporary names, and files
    // of an older run have their final names.
    nlohmann::json committed = manifest();
    std::size_t renamed = 0;
    for (const auto& file : committed.at("files").items()) {
        const std::string other = ".cascade-" + std::string(32, "0123456789"[renamed]) + ".npy";
        file.value()["written_as"] = other;
        ASSERT_TRUE(write_file(path("saved/run.json"), committed.dump()));
        fs::rename(path("saved/" + file.key()), path("saved/" + other));
        if (++renamed % 2 == 0) {
            ASSERT_TRUE(write_file(path("saved/" + file.key()), "of the run before"));
        }
        expect_resumable();
    }
    // The next save removes what was left.
    save(two_stages, 90);
    EXPECT_EQ(names(), before);
    expect_resumable();
}

TEST_F(SavedFolderTest, TheOldRunStaysWhereTheNewOneDoesNotFit) {
    save(two_stages, 70);
    const std::string before = bytes("saved/run.json");
    rlimit usual{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &usual), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{20000, usual.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    Overrides larger;
    larger.grid = GridSize{200, 200};
    Script script = load(two_stages, larger);
    RunRequest wanted = request();
    wanted.save = path("saved");
    wanted.stop_at = StopAt{"large", 1};
    const std::string why = run_badly(script, wanted);
    ::setrlimit(RLIMIT_FSIZE, &usual);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_THAT(why, HasSubstr("File too large"));
    EXPECT_EQ(bytes("saved/run.json"), before);
    EXPECT_EQ(names().size(), 4u) << "a, b and the varying beta, and run.json";
    expect_resumable();
}

TEST_F(SavedFolderTest, OnlyFilesOfTheRunBeforeAreRemoved) {
    save(two_stages, 70);
    const std::vector<std::string> others = {"notes.txt", "large.c.npy", "other.a.npy",
                                             ".cascade-mine.npy"};
    for (const std::string& name : others) ASSERT_TRUE(write_file(path("saved/" + name), "mine"));
    Script script = load("stage tiny: turing_spots { iterations: 3 }");
    RunRequest wanted = request();
    wanted.save = path("saved");
    run_well(script, wanted);
    for (const std::string& name : others) EXPECT_EQ(bytes("saved/" + name), "mine") << name;
    EXPECT_FALSE(fs::exists(path("saved/large.a.npy")));
    EXPECT_TRUE(fs::exists(path("saved/tiny.a.npy")));
    EXPECT_EQ(names().size(), others.size() + 4) << "a, b and the varying beta, and run.json";
}

TEST_F(SavedFolderTest, WhatIsNotASavedRunIsNotReplaced) {
    fs::create_directory(path("saved"));
    ASSERT_TRUE(write_file(path("saved/run.json"), "{\"name\": \"of another program\"}"));
    EXPECT_THAT(why_not_saved(two_stages),
                HasSubstr("is not replaced, because it does not belong to a saved run"));
    EXPECT_EQ(names().size(), 1u);
    fs::remove(path("saved/run.json"));
    ASSERT_TRUE(write_file(path("saved/small.b.npy"), "my own"));
    EXPECT_THAT(why_not_saved(two_stages),
                HasSubstr("small.b.npy' is not replaced, because it does not belong to the run"));
    EXPECT_EQ(bytes("saved/small.b.npy"), "my own");
    fs::remove(path("saved/small.b.npy"));
    fs::create_directory(path("saved/large.a.npy"));
    EXPECT_THAT(why_not_saved(two_stages), HasSubstr("large.a.npy"));
    fs::remove(path("saved/large.a.npy"));
    ASSERT_EQ(::mkfifo(path("saved/run.json").c_str(), 0600), 0);
    EXPECT_THAT(why_not_saved(two_stages), HasSubstr("does not belong to a saved run"));
    EXPECT_THAT(why_not_resumed(), HasSubstr("is a pipe or a device, not a file"));
    EXPECT_FALSE(fs::exists(path("picture.png"))) << "found before the first step";
}

TEST_F(SavedFolderTest, ARunOfAnEarlierVersionIsResumedAndReplaced) {
    save(two_stages, 70);
    nlohmann::json old = manifest();
    old.erase("files");
    ASSERT_TRUE(write_file(path("saved/run.json"), old.dump()));
    expect_resumable();
    ASSERT_TRUE(write_file(path("saved/large.old.npy"), "a parameter that varied"));
    save(two_stages, 90);
    EXPECT_FALSE(fs::exists(path("saved/large.old.npy")));
    expect_resumable();
}

TEST_F(SavedFolderTest, EveryChangedByteOfAnArrayIsNoticedAndItsFileNamed) {
    save(two_stages, 70);
    const std::string array = bytes("saved/large.b.npy");
    for (std::size_t at = 0; at < array.size(); at += 97) {
        std::string changed = array;
        changed[at] = static_cast<char>(changed[at] ^ 1);
        ASSERT_TRUE(write_file(path("saved/large.b.npy"), changed));
        ASSERT_THAT(why_not_resumed(), HasSubstr("large.b.npy has changed since the run was saved"))
            << at;
    }
    ASSERT_TRUE(write_file(path("saved/large.b.npy"), array.substr(0, array.size() - 4)));
    EXPECT_THAT(why_not_resumed(), HasSubstr("large.b.npy has changed"));
    ASSERT_TRUE(write_file(path("saved/large.b.npy"), bytes("saved/large.a.npy")));
    EXPECT_THAT(why_not_resumed(), HasSubstr("large.b.npy has changed"));
    fs::remove(path("saved/large.b.npy"));
    fs::create_symlink(path("elsewhere.npy"), path("saved/large.b.npy"));
    ASSERT_TRUE(write_file(path("elsewhere.npy"), array));
    EXPECT_THAT(why_not_resumed(), HasSubstr("large.b.npy' is a link, not a file"));
    fs::remove(path("saved/large.b.npy"));
    ASSERT_TRUE(write_file(path("saved/large.b.npy"), array));
    expect_resumable();
}

TEST_F(SavedFolderTest, ListsOfFilesAreNotBelieved) {
    save(two_stages, 70);
    const nlohmann::json good = manifest();
    const auto with = [&](const auto& change) {
        nlohmann::json changed = good;
        change(changed["files"]["large.b.npy"]);
        EXPECT_TRUE(write_file(path("saved/run.json"), changed.dump()));
        return why_not_resumed();
    };
    EXPECT_THAT(with([](auto& file) { file = nullptr; }), HasSubstr("does not name large.b.npy"));
    EXPECT_THAT(with([](auto& file) { file = 7; }), HasSubstr("does not name"));
    EXPECT_THAT(with([](auto& file) { file["bytes"] = -1; }), HasSubstr("does not name"));
    EXPECT_THAT(with([](auto& file) { file["bytes"] = "9"; }), HasSubstr("does not name"));
    EXPECT_THAT(with([](auto& file) { file["fnv1a"] = "x"; }), HasSubstr("does not name"));
    EXPECT_THAT(with([](auto& file) { file["written_as"] = "../../etc/passwd"; }),
                HasSubstr("does not name"));
    EXPECT_THAT(with([](auto& file) { file["bytes"] = std::uint64_t{1} << 63; }),
                HasSubstr("has changed"));
    nlohmann::json changed = good;
    changed["files"] = nlohmann::json::array();
    ASSERT_TRUE(write_file(path("saved/run.json"), changed.dump()));
    EXPECT_THAT(why_not_resumed(), HasSubstr("does not name"));
    // A save does not remove or rename files that the list in run.json names, either.
    ASSERT_TRUE(write_file(path("keep.npy"), "mine"));
    changed["files"] = {{"../keep.npy", good.at("files").at("large.b.npy")},
                        {"notes", good.at("files").at("large.b.npy")}};
    ASSERT_TRUE(write_file(path("saved/run.json"), changed.dump()));
    ASSERT_TRUE(write_file(path("saved/notes"), "mine"));
    for (const char* name : {"a", "b", "beta"})
        fs::remove(path(std::string("saved/large.") + name + ".npy"));
    save(two_stages, 70);
    EXPECT_EQ(bytes("keep.npy"), "mine");
    EXPECT_EQ(bytes("saved/notes"), "mine");
}

TEST_F(SavedFolderTest, WritersOfOneFolderWaitForEachOther) {
    save(two_stages, 70);
    const Descriptor other(::open(path("saved").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    ASSERT_EQ(::flock(other.number(), LOCK_EX), 0);
    std::thread soon([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        ::flock(other.number(), LOCK_UN);
    });
    save(two_stages, 90);
    soon.join();
    EXPECT_EQ(manifest().at("stages").at(0).at("steps"), 90);
}

}  // namespace
}  // namespace cascade
