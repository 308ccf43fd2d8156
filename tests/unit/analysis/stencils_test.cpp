// The table of differences: the weights agree with the other columns and with the symbols.
#include "analysis/wave_operators.h"
#include "lang/program/stencils.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace cascade::test {
namespace {

using Phases = std::array<double, 3>;

std::array<GridAxes, 3> axes_by_count() {
    return {GridAxes(Stencil::row), GridAxes(Stencil::plane), GridAxes(Stencil::volume)};
}

/// Σ weight exp(i θ·offset). For a difference at a face, offsets count from the face, half a cell
/// after the first cell.
std::complex<double> symbol_of(const Taps& taps, const Phases& phases) {
    std::complex<double> sum = 0;
    for (const auto& [at, weight] : taps.taps) {
        const double phase = at.dx * phases[0] + at.dy * phases[1] + at.dz * phases[2] -
                             (taps.at_face ? phases[0] / 2 : 0);
        sum += static_cast<double>(weight) * std::polar(1.0, phase);
    }
    return sum / static_cast<double>(taps.divisor);
}

std::complex<double> symbol(const StencilRow& row, const GridAxes& axes, const Phases& phases) {
    const auto of = [&](Difference each) { return symbol_of(taps_of(each, axes), phases); };
    if (row.error == 0) return of(row.base);
    return of(row.base) - of(row.outer) * of(row.inner) / row.error;
}

TEST(Stencils, HaveSymbolsUpToTheLargestOfTheirRow) {
    constexpr int steps = 12;
    for (const auto kind : {StencilKind::cross, StencilKind::isotropic, StencilKind::fourth}) {
        for (const auto of : {Difference::laplacian, Difference::second, Difference::central}) {
            const StencilRow row = stencil_row(kind, of);
            for (std::size_t count = 1; count <= 3; ++count) {
                const GridAxes axes = axes_by_count()[count - 1];
                double most = 0;
                for (int k = 0; k < (steps + 1) * (steps + 1) * (steps + 1); ++k) {
                    const auto phase = [&](int n) { return n * std::numbers::pi / steps; };
                    const Phases phases{phase(k % (steps + 1)),
                                        count > 1 ? phase(k / (steps + 1) % (steps + 1)) : 0,
                                        count > 2 ? phase(k / (steps + 1) / (steps + 1)) : 0};
                    most = std::max(most, std::abs(symbol(row, axes, phases)));
                    if (k >= steps && count == 1) break;
                }
                EXPECT_LE(most, row.largest[count - 1] * (1 + 1e-12));
                EXPECT_GE(most, row.largest[count - 1] * 0.99);
            }
        }
    }
}

TEST(Stencils, HaveTheSymbolsThatAnalysesTake) {
    using analysis::WaveOperator;
    const Phases phases{0.7, 1.9, 2.6};
    for (const auto kind : {StencilKind::cross, StencilKind::isotropic, StencilKind::fourth}) {
        analysis::Lattice lattice;
        lattice.has_axis = {true, true, true};
        lattice.stencil = kind;
        for (const auto of :
             {Difference::laplacian, Difference::second, Difference::central, Difference::across,
              Difference::average, Difference::backward, Difference::forward}) {
            const WaveOperator each{WaveOperator::Kind::difference, of, 0};
            const auto expected = symbol(stencil_row(kind, of), GridAxes(Stencil::volume), phases);
            const auto found = analysis::symbol({each}, lattice, {}, phases);
            EXPECT_LT(std::abs(found - expected), 1e-12) << static_cast<int>(of);
        }
    }
}

TEST(Stencils, AreDerivativesOfLongWaves) {
    const Phases phases{0.02, 0.01, 0.015};
    const GridAxes axes(Stencil::volume);
    const auto of = [&](Difference each) { return symbol_of(taps_of(each, axes, 0, 1), phases); };
    const double square = 0.02 * 0.02 + 0.01 * 0.01 + 0.015 * 0.015;
    const std::complex<double> first(0, 0.02);
    const auto is_near = [](std::complex<double> value, std::complex<double> expected) {
        return std::abs(value - expected) < 0.02 * std::abs(expected);
    };
    EXPECT_TRUE(is_near(of(Difference::laplacian), -square));
    EXPECT_TRUE(is_near(of(Difference::isotropic), -square));
    EXPECT_TRUE(is_near(of(Difference::second), -0.02 * 0.02));
    EXPECT_TRUE(is_near(of(Difference::mixed), -0.02 * 0.01));
    EXPECT_TRUE(is_near(of(Difference::average), 1));
    for (const auto each :
         {Difference::central, Difference::across, Difference::backward, Difference::forward}) {
        EXPECT_TRUE(is_near(of(each), first)) << static_cast<int>(each);
    }
}

TEST(Stencils, ReadTheCellsOfTheirWeights) {
    const GridAxes plane(Stencil::plane);
    const auto count = [](const Taps& taps) { return taps.taps.size(); };
    EXPECT_EQ(count(taps_of(Difference::laplacian, plane)), 5);
    EXPECT_EQ(count(taps_of(Difference::isotropic, plane)), 9);
    EXPECT_EQ(count(taps_of(Difference::isotropic, GridAxes(Stencil::volume))), 19);
    EXPECT_EQ(count(taps_of(Difference::mixed, plane, 0, 2)), 0);
    Node node{Call()};
    node.function = Function::dxy;
    EXPECT_EQ(offsets_of(node, plane), taps_of(Difference::mixed, plane, 0, 1).offsets());
    node.function = Function::diffuse;
    EXPECT_EQ(offsets_of(node, plane), taps_of(Difference::isotropic, plane).offsets());
}

}  // namespace
}  // namespace cascade::test
