// Operators, compared with calculus: manufactured solutions and their orders, directions,
// aggregates. A parameter may be computed with an operator, so the result of an operator can be
// read from a stage that has taken no step. tests/scripts/operators tests what operators conserve.
#include "run/simulation/simulation.h"

#include "core/grid.h"
#include "run/script/script.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

namespace cascade {
namespace {

using std::numbers::pi;

/// A script with a simulation that has started and may have taken steps.
class Started {
public:
    explicit Started(const std::string& text, bool runs = false)
        : script_(load_script("test", text, ".")) {
        EXPECT_TRUE(script_.program) << script_.messages(false) << text;
        if (!script_.program) return;
        simulation_ = Simulation::create(script_, {"interp", 0, 2}).value();
        for (std::uint32_t k = 0; k < script_.program->stages.size(); ++k) {
            EXPECT_TRUE(simulation_->start_stage(k)) << text;
            if (!runs) continue;
            RunControl control;
            const auto end = simulation_->advance_stage(k, script_.program->stages[k].iterations,
                                                        control, nullptr);
            EXPECT_TRUE(end) << (end ? "" : end.error().message);
        }
    }

    const Field& field(const std::string& name, std::uint32_t stage = 0) const {
        return simulation_->state(stage).field(item(name, stage));
    }
    float number(const std::string& name, std::uint32_t stage = 0) const {
        return static_cast<float>(simulation_->state(stage).numbers[item(name, stage)]);
    }
    bool is_uniform(const std::string& name) const {
        return script_.program->stages[0].uniform[item(name, 0)];
    }
    double sum(const std::string& name) const {
        const Field& cells = field(name);
        double sum = 0;
        for (std::int64_t row = 0; row < cells.layout().row_count(); ++row) {
            for (std::int64_t i = 0; i < cells.layout().width; ++i) sum += cells.row(row)[i];
        }
        return sum;
    }

private:
    ItemId item(const std::string& name, std::uint32_t stage) const {
        const System& system = script_.program->system_of(stage);
        for (const ItemId k : system.quantities.ids()) {
            if (system.quantities[k].name == name) return k;
        }
        ADD_FAILURE() << "no item " << name;
        return {};
    }

    Script script_;
    std::unique_ptr<Simulation> simulation_;
};

using Function2 = std::function<double(double x, double y)>;

/// The largest error of `operation`, applied to f, on a square of width 1 with `side` cells along
/// each side. `derivatives` is its order of differentiation, by which results are scaled from units
/// of the cell.
double largest_error(const std::string& operation, const std::string& extra, int side,
                     int derivatives, const Function2& exact, const std::string& boundary) {
    const Started run(
        fmt::format("system s {{ u: 0; u' = 0 * u\n {}\n r: {} }}\n"
                    "domain {{ grid: {}, {}; boundary: {} }}\nstage only: s {{ iterations: 0 }}\n",
                    extra, operation, side, side, boundary));
    const double scale = std::pow(side, derivatives);
    double largest = 0;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const double found = scale * run.field("r").number_at(i, j);
            largest =
                std::max(largest, std::abs(found - exact((i + 0.5) / side, (j + 0.5) / side)));
        }
    }
    return largest;
}

/// The derivative of a function by a difference so small that only rounding is left.
double along_x(const Function2& f, double x, double y) {
    return (f(x + 1e-5, y) - f(x - 1e-5, y)) / 2e-5;
}
double along_y(const Function2& f, double x, double y) {
    return (f(x, y + 1e-5) - f(x, y - 1e-5)) / 2e-5;
}

struct OperatorOrder {
    std::string operation;
    int derivatives;
    double order;
    Function2 exact;
};

void expect_orders(const std::vector<OperatorOrder>& cases, const std::string& extra,
                   const std::string& boundary) {
    for (const OperatorOrder& each : cases) {
        const double coarse =
            largest_error(each.operation, extra, 24, each.derivatives, each.exact, boundary);
        const double fine =
            largest_error(each.operation, extra, 48, each.derivatives, each.exact, boundary);
        const double order = std::log2(coarse / fine);
        EXPECT_NEAR(order, each.order, 0.2)
            << each.operation << " with " << boundary << ": " << coarse << ", " << fine;
        std::printf("%-44s order %.2f, error %.2g on 48²\n", each.operation.c_str(), order, fine);
    }
}

TEST(Operators, ConvergeAtTheirOrders) {
    const Function2 f = [](double x, double y) { return std::sin(2 * pi * (x + 2 * y)); };
    const auto c = [](double x, double y) { return std::cos(2 * pi * (x + 2 * y)); };
    const Function2 fx = [=](double x, double y) { return 2 * pi * c(x, y); };
    const Function2 fy = [=](double x, double y) { return 4 * pi * c(x, y); };
    const Function2 k = [](double x, double) { return 2 + std::cos(2 * pi * x); };
    const double cosine = std::cos(0.6), sine = std::sin(0.6);
    const auto tensor = [=](double a1, double a2) {
        return std::array{a1 * a1 * cosine * cosine + a2 * a2 * sine * sine,
                          (a1 * a1 - a2 * a2) * sine * cosine,
                          a1 * a1 * sine * sine + a2 * a2 * cosine * cosine};
    };
    const auto constant = tensor(2, 0.5);
    const Function2 flux_x = [=](double x, double y) {
        const auto a = tensor(k(x, y), 0.5);
        return a[0] * fx(x, y) + a[1] * fy(x, y);
    };
    const Function2 flux_y = [=](double x, double y) {
        const auto a = tensor(k(x, y), 0.5);
        return a[1] * fx(x, y) + a[2] * fy(x, y);
    };
    const double p2 = pi * pi;
    const auto of_constant = [=](double x, double y) {
        return -p2 * (4 * constant[0] + 16 * constant[2] + 16 * constant[1]) * f(x, y);
    };
    expect_orders(
        {
            {"lap(f)", 2, 2, [=](double x, double y) { return -20 * p2 * f(x, y); }},
            {"lap(2 * f + 1)", 2, 2, [=](double x, double y) { return -40 * p2 * f(x, y); }},
            {"lap(lap(f))", 4, 2, [=](double x, double y) { return 400 * p2 * p2 * f(x, y); }},
            {"dx(f)", 1, 2, fx},
            {"dy(f)", 1, 2, fy},
            {"dxx(f)", 2, 2, [=](double x, double y) { return -4 * p2 * f(x, y); }},
            {"dyy(f)", 2, 2, [=](double x, double y) { return -16 * p2 * f(x, y); }},
            {"dxy(f)", 2, 2, [=](double x, double y) { return -8 * p2 * f(x, y); }},
            {"dx(dy(f))", 2, 2, [=](double x, double y) { return -8 * p2 * f(x, y); }},
            {"grad2(f)", 2, 2, [=](double x, double y) { return 20 * p2 * c(x, y) * c(x, y); }},
            {"advect(0.7, -0.4, f)", 1, 1,
             [=](double x, double y) { return 0.7 * fx(x, y) - 0.4 * fy(x, y); }},
            {"div(grad(f))", 2, 2, [=](double x, double y) { return -20 * p2 * f(x, y); }},
            {"div(k * grad(f))", 2, 2,
             [=](double x, double y) {
                 return -20 * p2 * k(x, y) * f(x, y) + along_x(k, x, y) * fx(x, y);
             }},
            {"div(grad(f) / k - -grad(f))", 2, 2,
             [=](double x, double y) {
                 const Function2 flux = [=](double s, double t) {
                     return fx(s, t) * (1 / k(s, t) + 1);
                 };
                 return along_x(flux, x, y) - 16 * p2 * f(x, y) * (1 / k(x, y) + 1);
             }},
            {"div(vector(k * f, f))", 1, 2,
             [=](double x, double y) {
                 return along_x([=](double s, double t) { return k(s, t) * f(s, t); }, x, y) +
                        fy(x, y);
             }},
            {"diffuse(f, 2, 0.5, 0.6)", 2, 2, of_constant},
            {"div(tensor(2, 0.5, 0.6) * grad(f))", 2, 2, of_constant},
            {"div(tensor(k, 0.5, 0.6) * grad(f))", 2, 2,
             [=](double x, double y) { return along_x(flux_x, x, y) + along_y(flux_y, x, y); }},
            {"diffuse(f, k, 0.5, 0.6)", 2, 2,
             [=](double x, double y) {
                 const auto a = tensor(k(x, y), 0.5);
                 return -p2 * (4 * a[0] + 16 * a[2] + 16 * a[1]) * f(x, y);
             }},
        },
        "f: sin(2 * pi * (x + 2 * y))\n k: 2 + cos(2 * pi * x)", "periodic");
}

TEST(Operators, ConvergeAtSidesThatMirror) {
    const Function2 f = [](double x, double y) { return std::cos(pi * x) * std::cos(2 * pi * y); };
    const double p2 = pi * pi;
    const Function2 minus5 = [=](double x, double y) { return -5 * p2 * f(x, y); };
    expect_orders(
        {{"lap(f)", 2, 2, minus5},
         {"lap(exp(log(2 + f)) - 2)", 2, 2, minus5},
         {"div(grad(f))", 2, 2, minus5},
         {"dx(f)", 1, 2,
          [](double x, double y) { return -pi * std::sin(pi * x) * std::cos(2 * pi * y); }}},
        "f: cos(pi * x) * cos(2 * pi * y)", "noflux");
}

TEST(Operators, OfTheStencilFourthConvergeAtThatOrder) {
    const double p2 = pi * pi;
    const auto tried = [&](const Function2& f, const Function2& fx, const Function2& fy,
                           const Function2& fxx, const Function2& fyy, const Function2& fxy) {
        const auto both = [](const Function2& a, const Function2& b, double p, double q) {
            return Function2([=](double x, double y) { return p * a(x, y) + q * b(x, y); });
        };
        return std::vector<OperatorOrder>{
            {"lap(f)", 2, 4, both(fxx, fyy, 1, 1)},
            {"lap(2 * f + 1)", 2, 4, both(fxx, fyy, 2, 2)},
            {"lap(lap(f))", 4, 4,
             [=](double x, double y) {
                 return std::pow((fxx(x, y) + fyy(x, y)) / f(x, y), 2) * f(x, y);
             }},
            {"dx(f)", 1, 4, fx},
            {"dy(f)", 1, 4, fy},
            {"dyy(f)", 2, 4, fyy},
            {"dxy(f)", 2, 4, fxy},
            {"grad2(f)", 2, 4,
             [=](double x, double y) { return fx(x, y) * fx(x, y) + fy(x, y) * fy(x, y); }},
            {"dot(grad(f), vector(2, -1))", 1, 4, both(fx, fy, 2, -1)},
            {"div(grad(f))", 2, 2, both(fxx, fyy, 1, 1)},
        };
    };
    const auto s = [](double x, double y) { return std::sin(2 * pi * (x + 2 * y)); };
    const auto c = [](double x, double y) { return std::cos(2 * pi * (x + 2 * y)); };
    const auto times = [](double factor, auto of) {
        return Function2([=](double x, double y) { return factor * of(x, y); });
    };
    expect_orders(tried(s, times(2 * pi, c), times(4 * pi, c), times(-4 * p2, s),
                        times(-16 * p2, s), times(-8 * p2, s)),
                  "f: sin(2 * pi * (x + 2 * y))", "periodic; stencil: fourth; precision: double");
    const auto mirrored = [](double x, double y) {
        return std::cos(pi * x) * std::cos(2 * pi * y);
    };
    const auto in_x = [](double x, double y) { return std::sin(pi * x) * std::cos(2 * pi * y); };
    const auto in_y = [](double x, double y) { return std::cos(pi * x) * std::sin(2 * pi * y); };
    const auto in_both = [](double x, double y) { return std::sin(pi * x) * std::sin(2 * pi * y); };
    expect_orders(tried(mirrored, times(-pi, in_x), times(-2 * pi, in_y), times(-p2, mirrored),
                        times(-4 * p2, mirrored), times(2 * p2, in_both)),
                  "f: cos(pi * x) * cos(2 * pi * y)", "noflux; stencil: fourth; precision: double");
}

/// The error of the isotropic Laplacian is h²/12 lap(lap(f)), which is the same in all directions.
TEST(Operators, OfTheIsotropicStencilFavourNoDirection) {
    const auto error = [](const std::string& stencil, int across) {
        // Waves of equal length: (5, 0) and (3, 4) periods.
        const double a = across == 0 ? 5 : 3, b = across == 0 ? 0 : 4;
        const Function2 exact = [=](double x, double y) {
            return -100 * pi * pi * std::sin(2 * pi * (a * x + b * y));
        };
        return largest_error("lap(f)", fmt::format("f: sin(2 * pi * ({} * x + {} * y))", a, b), 96,
                             2, exact, "periodic; precision: double; stencil: " + stencil);
    };
    EXPECT_GT(error("cross", 0) / error("cross", 1), 1.5);
    EXPECT_NEAR(error("isotropic", 0) / error("isotropic", 1), 1, 0.02);
    // The leading error. Each Laplacian in it multiplies the wave by −100 π².
    EXPECT_NEAR(error("isotropic", 1), std::pow(100 * pi * pi, 2) / 12 / (96 * 96), 60);
    expect_orders(
        {{"lap(f)", 2, 2,
          [](double x, double y) { return -20 * pi * pi * std::sin(2 * pi * (x + 2 * y)); }}},
        "f: sin(2 * pi * (x + 2 * y))", "periodic; stencil: isotropic; precision: double");
}

/// Waves along and across the direction theta decay with a1² and a2² (Witkin & Kass, section 3).
TEST(Operators, DirectionsTurnFromXTowardsY) {
    const std::string waves =
        "theta: atan2(1, 2)\n along: sin(2 * pi * (2 * x + y))\n"
        "across: sin(2 * pi * (2 * y - x))";
    for (const char* of : {"diffuse({}, 2, 0.1, theta)", "div(tensor(2, 0.1, theta) * grad({}))"}) {
        const double q2 = 20 * pi * pi;
        const auto exact = [&](double rate, double a, double b) -> Function2 {
            return
                [=](double x, double y) { return -rate * q2 * std::sin(2 * pi * (a * x + b * y)); };
        };
        const std::string along = fmt::format(fmt::runtime(of), "along");
        const std::string across = fmt::format(fmt::runtime(of), "across");
        EXPECT_LT(largest_error(along, waves, 64, 2, exact(4, 2, 1), "periodic"), 0.05 * 4 * q2);
        EXPECT_LT(largest_error(across, waves, 64, 2, exact(0.01, -1, 2), "periodic"),
                  0.01 * 4 * q2);
    }
}

TEST(Operators, OfWhatIsTheSameEverywhereAreZero) {
    const Started run(
        "system s { u: 0.1; k: 0.3; u' = lap(k) + div(k * grad(k)) + advect(1, 1, k)"
        " + diffuse(k, 1, 2, 3)\n r: lap(k) + grad2(k * 3) }\n"
        "stage only: s { iterations: 3 }\n",
        true);
    EXPECT_TRUE(run.is_uniform("r"));
    EXPECT_EQ(run.number("r"), 0.0f);
    EXPECT_EQ(run.field("u").at(5, 5), 0.1f);
}

TEST(Aggregates, AreSumsMeansAndExtremes) {
    const Started run(
        "system s { u: 0; u' = 0 * u; f: x * 2 + y\n"
        "mean_f: mean(f over domain); sum_f: sum(f over domain)\n"
        "least: min(f over domain); largest: max(f * f over domain)\n"
        "again: mean(f - mean(f over domain) over domain) + least\n"
        "scaled: f - mean_f\n steep: max(grad2(f) over domain) }\n"
        "domain { grid: 40, 20; boundary: noflux }\nstage only: s { iterations: 0 }\n");
    EXPECT_TRUE(run.is_uniform("mean_f"));
    EXPECT_FALSE(run.is_uniform("scaled"));
    EXPECT_FLOAT_EQ(run.number("mean_f"), 1.25f);
    EXPECT_FLOAT_EQ(run.number("sum_f"), 1000.0f);
    EXPECT_FLOAT_EQ(run.number("least"), 0.0375f);
    const double most = 2 * 39.5 / 40 + 19.5 / 40;
    EXPECT_FLOAT_EQ(run.number("largest"), static_cast<float>(most * most));
    EXPECT_NEAR(run.number("again"), 0.0375, 1e-6);
    EXPECT_NEAR(run.sum("scaled"), 0, 1e-3);
    EXPECT_NEAR(run.number("steep"), 5.0 / 1600, 1e-8);
}

}  // namespace
}  // namespace cascade
