// Which tilings were found to be fastest is remembered in the process and on disk.
#include "run/stage/kept_tilings.h"
#include "tests/unit/solvers/cell_function_kernel.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace cascade {
namespace {

namespace fs = std::filesystem;

class KeptTilingsTest : public ::testing::Test {
protected:
    KeptTilingsTest() {
        std::string pattern = (fs::temp_directory_path() / "cascade-tilings-XXXXXX").string();
        EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        fs::permissions(folder_, fs::perms::owner_all);
    }
    ~KeptTilingsTest() override { fs::remove_all(folder_); }

    fs::path folder_;
};

const Tiling some_tiling{12, 3, 1, 4, true, Tiling::Along::columns};

TEST_F(KeptTilingsTest, AreFoundByLaterProcesses) {
    for (int times = 0; times < 2; ++times) KeptTilings(folder_, "code").keep("key", some_tiling);
    EXPECT_EQ(KeptTilings(folder_, "code").find("key"), some_tiling);
    EXPECT_EQ(KeptTilings(folder_, "code").find("other"), std::nullopt);
}

TEST_F(KeptTilingsTest, WhatWasFoundOnceIsNotTold) {
    const auto keep = [&](const Tiling& tiling) {
        KeptTilings(folder_, "code").keep("key", tiling);
    };
    const auto told = [&] { return KeptTilings(folder_, "code").find("key"); };
    keep(some_tiling);
    EXPECT_EQ(told(), std::nullopt);
    keep(some_tiling);
    EXPECT_EQ(told(), some_tiling);
    keep(Tiling());
    EXPECT_EQ(told(), std::nullopt);
    keep(some_tiling);
    EXPECT_EQ(told(), std::nullopt);
    keep(some_tiling);
    keep(some_tiling);
    EXPECT_EQ(told(), some_tiling);
}

TEST_F(KeptTilingsTest, WithoutAFolderOrACodeAreKnownToTheProcess) {
    for (const auto& [folder, code] :
         {std::pair<fs::path, std::string>{"", "code"}, {folder_, ""}}) {
        KeptTilings tilings(folder, code);
        tilings.keep("key", some_tiling);
        EXPECT_EQ(tilings.find("key"), std::nullopt);
        tilings.keep("key", some_tiling);
        EXPECT_EQ(tilings.find("key"), some_tiling);
        EXPECT_EQ(KeptTilings(folder, code).find("key"), std::nullopt);
    }
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(KeptTilingsTest, TextsGoBackAndForth) {
    for (const Tiling& tiling : {some_tiling, Tiling(), Tiling{16, 1, 1, 1, true}}) {
        for (const bool is_sure : {false, true}) {
            const FoundTiling found{tiling, is_sure};
            EXPECT_EQ(found_tiling_of(text_of(found)), found);
        }
    }
    for (const char* const text :
         {"", "16", "16 1 1 1 2 0 1", "16 1 1 1 0 0", "sixteen 1 1 1 0 0 0", "\xff\xff"}) {
        EXPECT_EQ(found_tiling_of(text), std::nullopt) << text;
    }
}

TEST_F(KeptTilingsTest, KeysDifferInAllThatDecides) {
    KeptTilings tilings(folder_, "code"), other_machine(folder_, "other code");
    const auto problem = [](const Grid& grid) { return test::heat_problem(grid, 0.1f); };
    const Grid grid{40, 30};
    for (int times = 0; times < 2; ++times)
        StageTilings(tilings, problem(grid), 1).keep(2, some_tiling);
    EXPECT_EQ(StageTilings(tilings, problem(grid), 1).find(2), some_tiling);
    EXPECT_EQ(StageTilings(tilings, problem(grid), 1).find(1), std::nullopt);
    EXPECT_EQ(StageTilings(tilings, problem(grid), 2).find(2), std::nullopt);
    EXPECT_EQ(StageTilings(tilings, problem(Grid{30, 40}), 1).find(2), std::nullopt);
    EXPECT_EQ(StageTilings(tilings, problem(Grid{40, 30, Boundary::no_flux}), 1).find(2),
              std::nullopt);
    StepProblem more = problem(grid);
    more.passes.push_back(more.passes[0]);
    EXPECT_EQ(StageTilings(tilings, more, 1).find(2), std::nullopt);
    EXPECT_EQ(StageTilings(other_machine, problem(grid), 1).find(2), std::nullopt);
}

}  // namespace
}  // namespace cascade
