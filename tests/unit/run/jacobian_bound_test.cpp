// Bounds of the rates' Jacobian, compared with the Jacobian that differences of whole steps give.
#include "lang/calculus/derivative.h"
#include "lang/library/library.h"
#include "run/simulation/simulation.h"
#include "run/simulation/stage_record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace cascade {
namespace {

using Vector = std::vector<double>;

/// A stage with one system. A step of length 1 adds the rates to the species.
class Rates {
public:
    explicit Rates(const std::string& text, std::int64_t warm_up = 0) {
        script_ = load_script("test", text, ".", {});
        EXPECT_TRUE(script_.program) << script_.messages(false);
        if (!script_.program) return;
        auto made = Simulation::create(script_, {"interp", 0, 1});
        EXPECT_TRUE(made);
        simulation_ = std::move(*made);
        EXPECT_TRUE(simulation_->start_stage(0));
        if (warm_up > 0) {
            RunControl control;
            EXPECT_TRUE(simulation_->advance_stage(0, warm_up, control, {}));
        }
        for (const Field& field : simulation_->state(0).species()) state_.push_back(field.clone());
    }

    bool ok() const { return simulation_ != nullptr; }
    std::optional<JacobianBound> bound() const {
        const auto model = simulation_->domain().shared_model();
        return jacobian_bound(*script_.program, 0, model ? &model->spread() : nullptr);
    }

    std::pair<double, double> bounds(const JacobianBound& bound) const {
        const Formula* const formulas[] = {&bound.whole, &bound.reaction};
        const std::vector<double> numbers = evaluate_numbers(*simulation_, formulas, 0);
        return {numbers[0], numbers[1]};
    }

    /// J v for every unit vector v, column by column.
    std::vector<Vector> jacobian() {
        std::vector<Vector> columns;
        for (std::size_t species = 0; species < state_.size(); ++species) {
            const PlaneLayout& layout = state_[species].layout();
            for (std::int64_t row = 0; row < layout.row_count(); ++row) {
                for (std::int64_t i = 0; i < layout.width; ++i) {
                    constexpr float step = 1e-3F;
                    Vector column = rates(species, row, i, step);
                    const Vector below = rates(species, row, i, -step);
                    for (std::size_t n = 0; n < column.size(); ++n) {
                        column[n] = (column[n] - below[n]) / (2 * step);
                    }
                    columns.push_back(std::move(column));
                }
            }
        }
        return columns;
    }

private:
    /// The rates after `by` is added to one value.
    Vector rates(std::size_t moved, std::int64_t row, std::int64_t column, float by) {
        std::vector<Field> species;
        for (const Field& field : state_) species.push_back(field.clone());
        species[moved].row(row)[column] += by;
        std::vector<Field> before;
        for (const Field& field : species) before.push_back(field.clone());
        const System& system = simulation_->domain().program->system_of(0);
        RecordedFields fields;
        for (const ItemId item : system.species()) {
            const std::size_t k = system.species_of(item)->index();
            fields.emplace(system.item_name(item), std::move(species[k]));
        }
        restore(*simulation_, 0, {{}, std::move(fields)});
        RunControl control;
        EXPECT_TRUE(simulation_->advance_stage(0, 1, control, {}));
        Vector rates;
        for (std::size_t k = 0; k < before.size(); ++k) {
            const Field& after = simulation_->state(0).species()[k];
            for (std::int64_t j = 0; j < after.layout().row_count(); ++j) {
                for (std::int64_t i = 0; i < after.layout().width; ++i) {
                    rates.push_back(double{after.row(j)[i]} - before[k].row(j)[i]);
                }
            }
        }
        return rates;
    }

    Script script_;
    std::unique_ptr<Simulation> simulation_;
    std::vector<Field> state_;
};

double length(const Vector& v) {
    double squares = 0;
    for (const double each : v) squares += each * each;
    return std::sqrt(squares);
}

/// The largest magnitude of an eigenvalue of J + shift, found as the factor by which repeated
/// products lengthen a vector.
double spectral_radius(const std::vector<Vector>& columns, double shift) {
    constexpr int products = 300;
    const std::size_t size = columns.size();
    Vector v(size);
    for (std::size_t n = 0; n < size; ++n) {
        v[n] = std::sin(12.9898 * static_cast<double>(n + 1) * static_cast<double>(n + 7));
    }
    double growth = 0;
    for (int count = 1; count <= 2 * products; ++count) {
        const double before = length(v);
        if (before == 0) return 0;
        Vector next(size);
        for (std::size_t n = 0; n < size; ++n) {
            next[n] += shift * v[n] / before;
            for (std::size_t m = 0; m < size; ++m) next[m] += columns[n][m] * v[n] / before;
        }
        v = std::move(next);
        if (count > products) growth += std::log(length(v)) / products;
    }
    return std::exp(growth);
}

std::string script_with_rates(const std::string& rates, const std::string& domain = "grid: 12, 6") {
    return "system s {\n u: 0.9 + 0.5 * sin(2 * pi * sx) + 0.1 * cos(2 * pi * sy)\n"
           " v: 1.2 + 0.4 * cos(2 * pi * sx)\n k: 1 + 0.3 * cos(2 * pi * sx)\n" +
           rates + "\n}\nstage one: s { iterations: 10; speed: 1; solver: euler }\ndomain { " +
           domain + " }\n";
}

/// Expects that no eigenvalue's magnitude exceeds the bound of the whole Jacobian, that this bound
/// is at most `at_most` times too large, and that no mode grows faster than the bound of the
/// reaction.
void expect_sound(const std::string& rates, double at_most,
                  const std::string& domain = "grid: 12, 6") {
    Rates run(script_with_rates(rates, domain));
    ASSERT_TRUE(run.ok()) << rates;
    const auto bound = run.bound();
    ASSERT_TRUE(bound) << rates;
    const auto [whole, reaction] = run.bounds(*bound);
    const std::vector<Vector> jacobian = run.jacobian();
    const double radius = spectral_radius(jacobian, 0);
    EXPECT_LE(radius, 1.02 * whole) << rates;
    EXPECT_GE(at_most * radius, whole) << rates;
    EXPECT_LE(spectral_radius(jacobian, whole) - whole, 1.02 * reaction + 0.02 * whole) << rates;
}

TEST(JacobianBounds, HoldForOperatorsOnThePlane) {
    expect_sound(" u' = 0.5 * lap(u) - u * v\n v' = 2 * lap(v) + u - v\n", 1.3);
    expect_sound(" u' = lap(u^3 - u - 0.5 * lap(u))\n v' = -v\n", 1.5);
    expect_sound(" u' = div(k * grad(u))\n v' = div(grad(v) / (1 + k))\n", 1.3);
    expect_sound(" u' = lap(u^2)\n v' = div(v * grad(v))\n", 1.6);
    expect_sound(" u' = diffuse(u, 2, 1, 0.4)\n v' = div(tensor(1, 2, k) * grad(v))\n", 1.3);
    expect_sound(" u' = lap(u) - div(5 * u * grad(v))\n v' = 10 * lap(v) + u - v\n", 1.3);
    expect_sound(" u' = -advect(1, 0.5, u)\n v' = -advect(u, 1, v)\n", 1.7);
    expect_sound(" u' = 0.1 * lap(u) + 0.5 * grad2(u)\n v' = dx(u * v)\n", 3.5);
    expect_sound(" u' = -div(vector(v, u) * u)\n v' = dxx(v) + 0.5 * dyy(v) - 0.2 * dxy(v)\n", 3);
    expect_sound(" u' = -lap(lap(u)) - 2 * lap(u) - u\n v' = -lap(lap(lap(v) + v) + k)\n", 1.5);
    expect_sound(" u' = 0.3 * lap(u) + mean(u * v over domain) - u\n v' = v * min(u over domain)\n",
                 3);
}

TEST(JacobianBounds, HoldInOtherUnitsAndDimensions) {
    expect_sound(" u' = 0.5 * lap(u) - dx(v)\n v' = diffuse(v, 1, 1, 0) - v\n", 1.6,
                 "grid: 12, 6; spacing: 0.5");
    expect_sound(" u' = lap(u) + u\n v' = div(k * grad(v))\n", 1.5,
                 "grid: 24, 1; boundary: noflux");
    expect_sound(" u' = lap(u) - u\n v' = dzz(v) - advect(0, 0, 1, v)\n", 1.6, "grid: 6, 4, 4");
}

TEST(JacobianBounds, HoldOnASurface) {
    const std::string torus =
        "grid: 12, 8; surface: (3 + cos(2*pi*sy)) * cos(2*pi*sx), (3 + cos(2*pi*sy)) * "
        "sin(2*pi*sx), "
        "sin(2*pi*sy)";
    const std::string sheared =
        "grid: 12, 6; boundary: noflux; surface: sx + 0.5 * sy, sy + 0.3*sx, 0";
    for (const std::string& domain : {torus, sheared}) {
        expect_sound(" u' = lap(u) - u\n v' = lap(v)\n", 1.6, domain);
        expect_sound(" u' = diffuse(u, 2, 1, 1)\n v' = div(k * grad(v))\n", 2, domain);
        expect_sound(" u' = div(tensor(2, 1, 0.3) * grad(u))\n v' = -advect(1, 1, v)\n", 3, domain);
        expect_sound(" u' = -lap(lap(u)) - lap(u)\n v' = grad2(v) - 0.1*v\n", 3, domain);
    }
}

TEST(JacobianBounds, GrowthThroughOperatorsIsThatOfTheory) {
    // In the equation of Cahn and Hilliard cos kx grows at the rate k² (1 − 3c²) − γ k⁴, which is
    // at most (1 − 3c²)² / 4γ.
    for (const double gamma : {0.25, 0.5, 2.0}) {
        Rates run(
            "system s {\n c: 0.3\n c' = lap(c^3 - c - " + std::to_string(gamma) +
            " * lap(c))\n}\nstage one: s { iterations: 10; speed: 1 }\ndomain { grid: 8, 8 }\n");
        const auto bound = run.bound();
        ASSERT_TRUE(bound);
        const double theory = std::pow(1 - 3 * 0.09, 2) / (4 * gamma);
        const double reaction = run.bounds(*bound).second;
        EXPECT_LE(reaction, 1.001 * theory);
        EXPECT_GE(reaction, 0.96 * theory);
    }
}

/// Every system in the library is tested after some steps.
TEST(JacobianBounds, HoldForTheLibrary) {
    int without_rule = 0;
    for (const LibraryText& text : library_texts()) {
        const std::string name(text.system_name());
        Rates run("domain { grid: 9, 6 }\nstage one: " + name + " { iterations: 100 }\n", 20);
        ASSERT_TRUE(run.ok()) << name;
        const auto bound = run.bound();
        if (!bound) {
            RecordProperty(name, "no rule");
            ++without_rule;
            continue;
        }
        const auto [whole, reaction] = run.bounds(*bound);
        EXPECT_GE(whole, reaction * 0.99) << name;
        RecordProperty(name, fmt::format("{:.3g} {:.3g}", whole, reaction));
    }
    EXPECT_LE(without_rule, 3);
}

}  // namespace
}  // namespace cascade
