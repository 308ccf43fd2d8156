// If all stages have crawling cells, the cells of the model are made only when something reads a
// value in them, and the values are the same as if these cells had been made at the start. The
// tests look into the cache to see whether the cells of the model were made.
#include "ran_text.h"

#include "lang/check/check.h"
#include "lang/syntax/parse.h"
#include "run/pictures/drawn_cells.h"
#include "tissue/tissue.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {
namespace {

class CellsWhenReadTest : public testing::Test {
protected:
    CellsWhenReadTest() { clear(); }

    void clear() {
        std::filesystem::remove_all(cache_);
        std::filesystem::create_directories(cache_);
    }
    Ran grown(const std::string& stage) {
        SimulationOptions options{"interp", 0, 2};
        options.cell_cache = cache_;
        return run_text(
            "cells herd { p' += cling(1) + push(1) }\n"
            "system flat { u: 0; u' = lap(u) }\n"
            "domain { surface: torus(1, 0.4); cells: 300 }\n" +
                stage,
            options);
    }
    static std::vector<double> shown(const Ran& ran) {
        const auto values = ran.simulation->evaluate(ran.script.program->stages[0].show, 0);
        return number_order(values[0], *ran.state().tissue());
    }
    bool has_cells_of_model() const { return !std::filesystem::is_empty(cache_); }

    const std::filesystem::path cache_ =
        std::filesystem::path(testing::TempDir()) / "cells_when_read";
};

TEST_F(CellsWhenReadTest, CellsThatCrawlNeedNoneOfTheModel) {
    const Ran ran = grown(
        "stage a: herd { founders: 20; iterations: 9; r: feature; show: dot(normal, p) + off }");
    EXPECT_EQ(shown(ran).size(), 20u);
    EXPECT_FALSE(has_cells_of_model());
    EXPECT_EQ(ran.simulation->domain().model->cells->count(), 300u);
    EXPECT_EQ(ran.simulation->domain().model->cells->spread().cells.places.size(), 300u);
    EXPECT_TRUE(has_cells_of_model());
}

TEST_F(CellsWhenReadTest, WhatIsReadLaterIsWhatARuleReads) {
    const auto values = [&](const std::string& rest) {
        return shown(grown("stage a: herd { founders: 20; iterations: 9; show: " + rest + " }"));
    };
    const std::vector<double> known = values("curvature; remove: curvature < 0");
    ASSERT_EQ(known.size(), 20u);
    EXPECT_TRUE(has_cells_of_model());
    clear();
    Ran later = grown("stage a: herd { founders: 20; iterations: 9 }");
    EXPECT_FALSE(has_cells_of_model());
    Diagnostics diagnostics;
    const SourceId source = later.script.sources.add("view", "curvature");
    const auto read =
        parse_expression(source, later.script.sources, later.script.tree, diagnostics);
    const auto view = check_view(later.script.tree, *read, 0, 0, *later.script.program,
                                 later.script.sources, diagnostics);
    EXPECT_EQ(number_order(later.simulation->evaluate(*view, 0)[0], *later.state().tissue()),
              known);
    EXPECT_TRUE(has_cells_of_model());
}

TEST_F(CellsWhenReadTest, FieldsHaveThemFromTheStart) {
    grown("stage a: flat { iterations: 1; speed: 0.1 }");
    EXPECT_TRUE(has_cells_of_model());
}

}  // namespace
}  // namespace cascade
