// A stage's `size` is the wavelength of its pattern, on planes, lines and models.
#include "core/file.h"
#include "lang/program/scaled_lengths.h"
#include "measure/spectrum.h"
#include "ran_text.h"
#include "run_fixture.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace cascade {
namespace {

SimulationOptions fastest_options() {
    SimulationOptions options;
    return options;
}

double factor_of(const Ran& ran, std::uint32_t stage = 0) {
    return ran.simulation->domain().stage(stage).size->factor;
}

/// The wavelength of the last stage's pattern, in units of the domain.
double wavelength_of(const Ran& ran) {
    const auto stage = static_cast<std::uint32_t>(ran.script.stage_count() - 1);
    const Formula& shown = ran.simulation->domain().stage(stage).show;
    const auto samples = measure::to_samples(ran.simulation->evaluate(shown, stage)[0],
                                             ran.simulation->domain().grid);
    return measure::peak_wavelength(measure::in_wide_rings(measure::radial_spectrum(samples)));
}

/// The wavelength of a field on a model, in units: that of the peak of its spectrum, as on the
/// plane. The power at each eigenvalue −k² of the discrete Laplacian follows from the moments ⟨u,
/// Tₙ(L) u⟩ of Chebyshev polynomials (A. Weiße et al., Reviews of Modern Physics 78, 275, 2006).
double wavelength_on(const ModelCells& model, std::vector<double> values) {
    const SpreadCells& spread = model.spread();
    const SurfaceCells& cells = spread.cells;
    const std::size_t count = values.size();
    double area = 0, sum = 0, most = 0;
    for (std::size_t i = 0; i < count; ++i) {
        area += cells.areas[i];
        sum += cells.areas[i] * values[i];
        double weight = 0;
        for (const VoronoiEdge& edge : cells.edges_of(i)) weight += edge.weight();
        most = std::max(most, 2 * weight / cells.areas[i]);
    }
    for (double& value : values) value -= sum / area;
    // x = 2 (−L) / most − 1, from −1 for long waves to 1 for short waves.
    const auto times_x = [&](const std::vector<double>& v) {
        std::vector<double> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            double flow = 0;
            for (const VoronoiEdge& edge : cells.edges_of(i))
                flow += edge.weight() * (v[i] - v[edge.neighbour]);
            result[i] = 2 * flow / cells.areas[i] / most - v[i];
        }
        return result;
    };
    const auto product = [&](const std::vector<double>& v) {
        double dot = 0;
        for (std::size_t i = 0; i < count; ++i) dot += cells.areas[i] * values[i] * v[i];
        return dot;
    };
    constexpr int moments = 1200, angles = 4 * moments;
    std::vector<double> moment;
    std::vector<double> before = values, now = times_x(values);
    moment.push_back(product(before));
    moment.push_back(product(now));
    for (int n = 2; n < moments; ++n) {
        std::vector<double> next = times_x(now);
        for (std::size_t i = 0; i < count; ++i) next[i] = 2 * next[i] - before[i];
        before = std::exchange(now, std::move(next));
        moment.push_back(product(now));
    }
    // The power as a function of the angle θ in x = −cos θ, with Jackson's kernel against ringing.
    using std::numbers::pi;
    std::vector<double> power(angles), wave(angles);
    for (int a = 0; a < angles; ++a) {
        const double theta = pi * (a + 0.5) / angles;
        const double q = pi / (moments + 1);
        for (int n = 0; n < moments; ++n) {
            const double jackson =
                ((moments - n + 1) * std::cos(q * n) + std::sin(q * n) / std::tan(q)) /
                (moments + 1);
            power[a] += (n == 0 ? 1 : 2) * jackson * moment[n] * std::cos(n * (pi - theta));
        }
        wave[a] = std::sqrt((1 - std::cos(theta)) / 2 * most) * spread.unit;
    }
    // The peak is found as in measure/spectrum.cpp. It is smooth, because the number of moments is
    // finite.
    const auto peak = std::max_element(power.begin(), power.end()) - power.begin();
    double whole = 0, first = 0;
    for (int a = 0; a < angles; ++a) {
        if (wave[a] < wave[peak] / 1.3 || wave[a] > wave[peak] * 1.3) continue;
        whole += power[a];
        first += power[a] * wave[a];
    }
    return 2 * pi * whole / first;
}

/// The bits of all species after a few steps, with lengths multiplied by `factor`.
std::vector<std::vector<double>> after_steps(const std::string& text, double factor) {
    Script script = load_script("test", text, ".");
    EXPECT_TRUE(script.program) << script.messages(false);
    if (!script.program) return {};
    script.program = std::make_shared<const Program>(with_lengths(*script.program, 0, factor));
    auto made = Simulation::create(script, {"interp", 0, 1});
    EXPECT_TRUE(made);
    EXPECT_TRUE((*made)->start_stage(0));
    RunControl control;
    EXPECT_TRUE((*made)->advance_stage(0, 20, control, {}));
    std::vector<std::vector<double>> values;
    for (const Field& field : (*made)->state(0).species())
        values.push_back(measure::to_samples(field, (*made)->domain().grid).values);
    return values;
}

// Products with powers of two are exact.
TEST(ScaledLengths, AreAnotherSpacing) {
    constexpr const char* text = R"(
system all {{
  u: gauss(0.4, 0.6, 0.1)
  v: sx * sy
  w: gauss(0.5, 0.3, 0.2)
  J = vector(u, v) - 0.5 * grad(v)
  slope_of_v = dx(v) + 0.1 * dy(v)
  more = diffuse(v, 0.5, 0.2, 0.3) + div(symmetric(0.2, 0.1, 0.3) * grad(v)) + mean(u over domain)
  u' = lap(u) + 0.1 * dxx(v) - 0.05 * lap(lap(u)) + div((1 + v) * grad(u)) + dxy(v) + 0.1 * white(1)
  v' = slope_of_v + 0.001 * sum(u over domain) + 0.1 * grad2(u) - div(J) + curl(J) + more
  w' = 0.5 * lap(w) + advect(0.3, 0.2, w) + transport(0.1, 0.2, v) + dot(grad(u), grad(v))
  u.left: slope(0.1 + 0.2 * v)
  w.right: flux(0.3 - 0.1 * w)
  v.top: fixed(0.3 + 0.1 * u)
}}
domain {{ grid: 24, 20; boundary: noflux; spacing: {} }}
stage s: all {{ speed: 0.001; iterations: 20; u.right: slope(-0.2) }}
)";
    const auto finer = after_steps(fmt::format(text, 0.5), 1);
    EXPECT_EQ(finer, after_steps(fmt::format(text, 1), 2));
    EXPECT_NE(finer, after_steps(fmt::format(text, 1), 1));
    EXPECT_EQ(after_steps(fmt::format(text, 2), 1), after_steps(fmt::format(text, 0.5), 0.25));
}

// Sides belong to the domain, which all stages share, so their lengths are not multiplied.
TEST(ScaledLengths, LeaveSidesOfTheDomainAlone) {
    const auto with = [](const char* of_domain, const char* of_stage) {
        return after_steps(fmt::format("system s {{ u: sx; u' = lap(u) }}\n"
                                       "domain {{ grid: 16; boundary: noflux; {} }}\n"
                                       "stage only: s {{ speed: 0.01; iterations: 20; {} }}\n",
                                       of_domain, of_stage),
                           2);
    };
    EXPECT_EQ(with("left: slope(0.1)", ""), with("", "u.left: slope(0.2)"));
}

struct SizeCase {
    const char* system;
    double size;
    const char* more = "";
};

class Sizes : public ::testing::TestWithParam<SizeCase> {};

TEST_P(Sizes, AreThoseOfThePattern) {
    const auto [system, size, more] = GetParam();
    // The domain is many waves wide, so that results hardly depend on the seed.
    const int side = static_cast<int>(std::min(384.0, 24 * size)) / 16 * 16;
    const Ran ran = run_text(fmt::format("domain {{ grid: {0}, {0}; seed: 7 }}\n"
                                         "stage s: {1} {{ size: {2}; {3} }}\n",
                                         side, system, size, more),
                             fastest_options());
    ASSERT_EQ(ran.failure, "");
    EXPECT_NEAR(wavelength_of(ran) / size, 1, 0.02) << "factor " << factor_of(ran);
}

TEST(SizesOnModels, AreThoseOfThePattern) {
    const Ran ran = run_text(
        "domain { surface: torus; cells: 16384; unit: 0.02 }\n"
        "stage s: turing_spots { size: 16 }\n",
        fastest_options());
    ASSERT_EQ(ran.failure, "");
    const ModelCells& model = *ran.simulation->domain().model->cells;
    EXPECT_NEAR(wavelength_on(model, cell_values(ran.species(1), model)) / 16, 1, 0.02)
        << "factor " << factor_of(ran);
}

INSTANTIATE_TEST_SUITE_P(OfThePlane, Sizes,
                         ::testing::Values(SizeCase{"turing_spots", 8},
                                           SizeCase{"turing_spots", 16}, SizeCase{"brusselator", 7},
                                           SizeCase{"schnakenberg", 14},
                                           SizeCase{"lengyel_epstein", 8}));

}  // namespace
}  // namespace cascade
