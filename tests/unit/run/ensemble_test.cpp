// Ensembles of a sweep: runs that differ only in their seed.
#include "core/csv.h"
#include "picture/axes.h"
#include "run/commands/ensemble.h"
#include "run/commands/variation.h"

#include <gmock/gmock.h>

#include <cmath>

namespace cascade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The results of runs with these wavelengths. Runs with NaN are missing.
std::vector<std::optional<SweepResult>> results_with(const std::vector<double>& wavelengths) {
    std::vector<std::optional<SweepResult>> results(wavelengths.size());
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (std::isnan(wavelengths[k])) continue;
        results[k].emplace().features.emplace().wavelength = wavelengths[k];
    }
    return results;
}

std::vector<Variation> varied(const std::vector<std::string>& texts) {
    std::vector<Variation> all;
    for (const std::string& text : texts) all.push_back(*parse_variation(text));
    return all;
}

/// The cells of the first row of a table that begins with these cells.
std::vector<std::string> row_of(const std::string& table, const std::vector<std::string>& begins) {
    const auto rows = read_csv(table);
    for (const auto& row : *rows) {
        bool is_it = true;
        for (std::size_t k = 0; k < begins.size(); ++k) is_it = is_it && row[k].text == begins[k];
        if (!is_it) continue;
        std::vector<std::string> cells;
        for (const CsvCell& cell : row) cells.push_back(cell.text);
        return cells;
    }
    return {};
}

TEST(Ensemble, ATableHasTheStatisticsOfEachCombination) {
    // Runs are numbered with the first name fastest: (1, 5), (2, 5), (1, 6), (2, 6), (1, 7), (2,
    // 7).
    auto results = results_with({10, 20, 14, NAN, 12, NAN});
    results.back().emplace();  // A run that failed.
    const auto names = varied({"ka=1,2", "seed=5,6,7"});
    const std::string table = ensemble_table(results, names);
    EXPECT_THAT(row_of(table, {"ka"}),
                ElementsAre("ka", "number", "runs", "mean", "deviation", "low", "high"));
    // Student's table has 4.303 for 2 degrees of freedom.
    const auto first = row_of(table, {"1", "wavelength"});
    ASSERT_EQ(first.size(), 7U);
    EXPECT_EQ(first[2], "3");
    EXPECT_EQ(first[3], "12");
    EXPECT_EQ(first[4], "2");
    EXPECT_NEAR(std::stod(first[6]), 12 + 4.30265 * 2 / std::sqrt(3), 1e-4);
    EXPECT_THAT(row_of(table, {"2", "wavelength"}),
                ElementsAre("2", "wavelength", "1", "20", "", "", ""));
    EXPECT_THAT(row_of(table, {"1", "angle"}), ElementsAre());
}

TEST(Ensemble, OnlySweepsWithSeveralSeedsHaveEnsembles) {
    EXPECT_TRUE(has_ensembles(varied({"ka=1,2", "seed=5,6"})));
    EXPECT_TRUE(has_ensembles(varied({"(ka, seed)=(1, 5), (2, 6)"})));
    EXPECT_FALSE(has_ensembles(varied({"ka=1,2", "seed=5"})));
    EXPECT_FALSE(has_ensembles(varied({"ka=1,2"})));
}

TEST(Ensemble, SeedsAreARangeOrAList) {
    EXPECT_THAT(parse_seeds("3..6")->values, ElementsAre("3", "4", "5", "6"));
    EXPECT_THAT(parse_seeds("7, 2")->values, ElementsAre("7", "2"));
    EXPECT_THAT(parse_seeds("4294967295..4294967295")->values, ElementsAre("4294967295"));
    for (const char* wrong : {"", "x", "1..", "..3", "-1..3", "1.5", "1..4294967296", "1,,2"}) {
        ASSERT_FALSE(parse_seeds(wrong)) << wrong;
        EXPECT_THAT(parse_seeds(wrong).error().message, HasSubstr("a seed must be a whole number"));
    }
    EXPECT_THAT(parse_seeds("5..1").error().message, HasSubstr("the first seed is above the last"));
    EXPECT_THAT(parse_seeds("0..10000").error().message, HasSubstr("more than 10000 runs"));
}

TEST(Ensemble, ACurveNeedsANameWithNumbers) {
    const auto fault = [](const char* number, const std::vector<std::string>& texts) {
        const auto good = check_curve(number, varied(texts));
        return good ? std::string() : good.error().message;
    };
    EXPECT_EQ(fault("wavelength", {"ka=1/4,1/2", "solver=euler,rk4", "seed=1,2"}), "");
    EXPECT_EQ(fault("cells", {"seed=1,2", "ka=1,2"}), "");
    EXPECT_THAT(fault("waves", {"ka=1,2"}), HasSubstr("cannot draw a curve of 'waves'"));
    EXPECT_THAT(fault("angle", {"ka=1,2"}), HasSubstr("cannot draw a curve of 'angle'"));
    EXPECT_THAT(fault("mean", {"seed=1,2"}), HasSubstr("other than the seed"));
    EXPECT_THAT(fault("mean", {"solver=euler,rk4"}),
                HasSubstr("'euler' of solver is not a number"));
}

TEST(Ensemble, ACurveHasADiscForEachMeanAndABarForEachInterval) {
    const auto results = results_with({10, 20, 14, NAN});
    const auto names = varied({"ka=1,2", "seed=5,6"});
    const Drawing drawing = draw_curve("wavelength", results, names);
    int discs = 0, bars = 0;
    for (const auto& shape : drawing.shapes) {
        discs += std::holds_alternative<DrawnDisc>(shape) ? 1 : 0;
        const auto* line = std::get_if<DrawnLine>(&shape);
        const bool is_upright = line && line->points.size() == 2 &&
                                line->points[0][0] == line->points[1][0] && line->width == 1;
        bars += is_upright && line->colour != axis_ink && line->colour != axis_faint ? 1 : 0;
    }
    EXPECT_EQ(discs, 2);
    EXPECT_EQ(bars, 1);
    EXPECT_THAT(as_svg(draw_curve("spots", results_with({NAN, NAN}), varied({"ka=1,2"}))).value(),
                HasSubstr("no run has this feature"));
}

}  // namespace
}  // namespace cascade
