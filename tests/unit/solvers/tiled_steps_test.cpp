// Taking several steps in one pass through memory gives the bits of single steps. The tests use
// random systems of passes, registers and temporaries, on all kinds of grids and on linked cells.
#include "solvers/stepper.h"

#include "core/floating_point.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cascade::test {
namespace {

/// Random numbers that are determined by a seed.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
    std::int64_t below(std::int64_t count) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::int64_t>((state_ >> 33) % static_cast<std::uint64_t>(count));
    }
    bool often() { return below(3) > 0; }

private:
    std::uint64_t state_;
};

/// A kernel whose result r is a sum over all fields of the cell itself and, for most fields, of all
/// cells around. In frozen cells of a mask field 0 is kept. After each row it writes NaN, as
/// kernels may.
template <typename Number>
class SumKernel : public Kernel {
public:
    SumKernel(std::vector<bool> own_only, Stencil stencil)
        : own_only_(std::move(own_only)), stencil_(stencil) {}

    using Kernel::run;
    void run(const KernelArgumentsOf<Number>& given, const Patch& cells) const override {
        const PlaneLayout& layout = given.layout;
        const std::int64_t pad = PlaneLayout::row_pad;
        std::vector<Number> sums(own_only_.size()), values(given.results.size());
        ColumnRange columns = cells.columns;
        if (columns.end >= layout.width) columns.end = (layout.width + pad - 1) / pad * pad;
        for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
            const std::int64_t start = layout.row_start(row);
            for (std::int64_t i = columns.begin; i < columns.end; ++i) {
                const bool is_cell = i < layout.width;
                for (std::size_t f = 0; is_cell && f < sums.size(); ++f) {
                    sums[f] = own_only_[f] ? Number{0} : around(given, f, row, i);
                }
                for (std::size_t r = 0; is_cell && r < values.size(); ++r) {
                    values[r] = value(given, r, start + i, sums);
                }
                for (std::size_t r = 0; r < values.size(); ++r) {
                    given.results[r][start + i] =
                        is_cell ? values[r] : std::numeric_limits<Number>::quiet_NaN();
                }
            }
        }
    }

private:
    Number value(const KernelArgumentsOf<Number>& given, std::size_t result, std::int64_t at,
                 const std::vector<Number>& sums) const {
        if (!given.masks.empty() && given.masks[0][at] != 0) return given.fields[0][at];
        Number value = given.uniforms[0];
        for (std::size_t f = 0; f < sums.size(); ++f) {
            const auto weight =
                static_cast<Number>(0.9 / static_cast<double>(sums.size() + result + f));
            value += weight * given.fields[f][at] + static_cast<Number>(0.003) * sums[f];
        }
        return value / (1 + value * value);
    }

    Number around(const KernelArgumentsOf<Number>& given, std::size_t field, std::int64_t row,
                  std::int64_t column) const {
        const PlaneLayout& layout = given.layout;
        const std::int64_t at = layout.row_start(row) + column;
        const Number* cells = given.fields[field];
        Number sum = 0;
        if (stencil_.links) {
            const std::int64_t slices = (layout.width + 15) / 16;
            const std::int64_t slice = row * slices + column / 16;
            for (std::uint32_t e = given.links.starts[slice]; e < given.links.starts[slice + 1];
                 ++e) {
                const std::int64_t link = 16 * static_cast<std::int64_t>(e) + column % 16;
                sum += given.links.weights[link] * cells[given.links.target(link)];
            }
            return sum;
        }
        for (std::int64_t dz = -std::int64_t{stencil_.z}; dz <= std::int64_t{stencil_.z}; ++dz) {
            for (std::int64_t dy = -std::int64_t{stencil_.y}; dy <= std::int64_t{stencil_.y};
                 ++dy) {
                for (std::int64_t dx = -std::int64_t{stencil_.x}; dx <= std::int64_t{stencil_.x};
                     ++dx) {
                    sum += cells[at + dz * layout.slice_stride + dy * layout.stride + dx];
                }
            }
        }
        return sum;
    }

    std::vector<bool> own_only_;
    Stencil stencil_;
};

/// A step of random passes, and what they read.
template <typename Number>
class RandomSystem {
public:
    RandomSystem(const Grid& grid, std::uint64_t seed) : layout_(grid), dice_(seed) {
        problem_.grid = grid;
        problem_.precision = precision_of<Number>;
        species_ = static_cast<std::uint32_t>(1 + dice_.below(3));
        problem_.registers = static_cast<std::uint32_t>(2 + dice_.below(3));
        problem_.temporaries = static_cast<std::uint32_t>(dice_.below(3));
        problem_.species_needs_halo.assign(species_, true);
        if (grid.linked) add_links();
        fixed_ = Field(layout_, precision_of<Number>);
        fill(fixed_, 99);
        fixed_.fill_halo(grid.boundary);
        mask_ = Mask(layout_);
        for (std::int64_t row = 0; row < layout_.row_count(); ++row) {
            for (std::int64_t i = 0; i < grid.width; ++i) mask_.row(row)[i] = dice_.below(7) == 0;
        }
        add_sides();
        const std::int64_t passes = 1 + dice_.below(4);
        for (std::int64_t pass = 0; pass < passes; ++pass) add_pass(pass + 1 == passes);
    }

    const StepProblem& problem() const { return problem_; }
    std::vector<Field> start() const {
        std::vector<Field> fields;
        for (std::uint32_t s = 0; s < species_; ++s) {
            fill(fields.emplace_back(layout_, precision_of<Number>), s);
        }
        return fields;
    }
    std::string cells(std::span<const Field> fields) const {
        std::string bytes;
        for (const Field& field : fields) {
            for (std::int64_t row = 0; row < layout_.row_count(); ++row) {
                const auto size = static_cast<std::size_t>(layout_.width) * sizeof(Number);
                bytes.append(reinterpret_cast<const char*>(field.row<Number>(row)), size);
            }
        }
        return bytes;
    }

private:
    using PlaneRef = StepProblem::PlaneRef;
    using SpeciesPlane = StepProblem::SpeciesPlane;

    void fill(Field& field, std::uint64_t number) const {
        for (std::int64_t row = 0; row < layout_.row_count(); ++row) {
            for (std::int64_t i = 0; i < layout_.width; ++i) {
                const auto mixed =
                    static_cast<std::uint64_t>(row * 7919 + i * 104729) + number * 31;
                field.row<Number>(row)[i] =
                    static_cast<Number>((mixed * 2654435761u >> 7) % 1000) / 1000;
            }
        }
    }
    void add_links() {
        LinkList list;
        const std::int64_t cells = problem_.grid.cell_count(), most = 3 * problem_.grid.width;
        for (std::int64_t cell = 0; cell < cells; ++cell) {
            for (std::int64_t k = dice_.below(5); k > 0; --k) {
                const std::int64_t to = cell + dice_.below(most) - most / 2;
                list.neighbours.push_back(
                    static_cast<std::uint32_t>(std::clamp<std::int64_t>(to, 0, cells - 1)));
                list.weights.push_back(0.1 * static_cast<double>(k));
            }
            list.ends.push_back(list.neighbours.size());
        }
        links_ = Links(list, layout_, precision_of<Number>);
        problem_.links = &links_;
    }
    void add_sides() {
        for (std::uint32_t s = 0; s < species_ && dice_.often(); ++s) {
            problem_.sides.assign(species_, SideRules(problem_.grid.boundary));
            SideRule& rule = problem_.sides[s].at[static_cast<std::size_t>(dice_.below(6))];
            if (rule.kind == SideKind::periodic) continue;
            rule.kind = dice_.often() ? SideKind::fixed : SideKind::slope;
            rule.value = 0.25;
        }
    }
    /// A plane that the step has written, one of the old step, or the fixed one.
    PlaneRef some_plane() {
        const std::int64_t choice = dice_.below(6);
        if (choice == 0) return &fixed_;
        if (choice < 3 || written_.empty()) {
            return SpeciesPlane{SpeciesId(static_cast<std::size_t>(dice_.below(species_))),
                                old_register};
        }
        return written_[static_cast<std::size_t>(
            dice_.below(static_cast<std::int64_t>(written_.size())))];
    }
    void add_pass(bool is_last) {
        StepProblem::Pass pass;
        const bool to_temporary = !is_last && problem_.temporaries > 0 && dice_.often();
        const RegisterId target(
            is_last || problem_.registers == 2 ? 1 : 1 + dice_.below(problem_.registers - 1));
        const std::uint32_t results = to_temporary ? problem_.temporaries : species_;
        for (std::uint32_t k = 0; k < results; ++k) {
            StepProblem::Result result;
            if (to_temporary) {
                result.plane = TemporaryId(k);
            } else {
                result.plane = SpeciesPlane{SpeciesId(k), target};
            }
            result.needs_halo = true;
            result.boundary = problem_.grid.boundary;
            pass.results.push_back(result);
        }
        std::vector<bool> own_only;
        for (std::int64_t fields = 1 + dice_.below(4); fields > 0; --fields) {
            const PlaneRef plane = some_plane();
            const bool is_result =
                std::any_of(pass.results.begin(), pass.results.end(),
                            [&](const auto& result) { return result.plane == plane; });
            pass.fields.push_back(plane);
            own_only.push_back(is_result || !dice_.often());
        }
        if (dice_.below(3) == 0) pass.masks = {&mask_};
        pass.uniforms = {0.1};
        if (dice_.often()) pass.changing = {{UniformSlot(0), StepProblem::MomentAt{0.5}}};
        pass.kernel = std::make_shared<SumKernel<Number>>(own_only, problem_.grid.stencil());
        if (dice_.below(8) == 0) {
            pass.reductions = {
                {ReductionKind::sum, SpeciesPlane{SpeciesId(0), old_register}, AggregateId(0)}};
            pass.changing = {{UniformSlot(0), AggregateId(0)}};
            problem_.aggregates = 1;
        }
        for (const StepProblem::Result& result : pass.results) written_.push_back(result.plane);
        problem_.passes.push_back(std::move(pass));
    }

    PlaneLayout layout_;
    Dice dice_;
    std::uint32_t species_ = 1;
    Links links_;
    Field fixed_;
    Mask mask_;
    StepProblem problem_;
    std::vector<PlaneRef> written_;
};

/// Takes steps in batches. Between them it reads, keeps and restores the species.
template <typename Number>
std::string steps_of(const RandomSystem<Number>& system, const Tiling& tiling, int threads,
                     const MakeExecutor& make = make_thread_executor) {
    const FlushDenormals environment;
    Stepper stepper(system.problem(), system.start(), threads, true, make);
    stepper.executor().use_tiling(tiling);
    StageClock clock;
    clock.step = 0.01;
    clock.precision = precision_of<Number>;
    stepper.set_clock(clock);
    std::int64_t complete = 0;
    const auto go = [&](std::int64_t count, bool look) {
        EXPECT_TRUE(stepper.advance(complete, count, look));
        complete += count;
    };
    go(1, true);
    go(5, true);
    stepper.keep();
    go(6, false);
    go(3, true);
    const std::string before = system.cells(stepper.species());
    stepper.back();
    complete = 6;
    go(6, false);
    go(3, true);
    // The kept copy was not written.
    EXPECT_TRUE(before == system.cells(stepper.species()));
    stepper.keep();
    go(4, true);
    return system.cells(stepper.species());
}

template <typename Number>
void compare(const Grid& grid, std::uint64_t seed) {
    const RandomSystem<Number> system(grid, seed);
    const std::string plain = steps_of(system, {}, 1);
    Dice dice(seed + 1000);
    for (const int threads : {1, 2, 3, 8}) {
        Tiling tiling;
        tiling.levels = static_cast<int>(2 + dice.below(14));
        const std::int64_t reach = grid.linked ? rows_reached(system.problem()) : 1;
        tiling.outer_layer = reach + dice.below(3);
        tiling.inner_layer = 1 + dice.below(2);
        tiling.inner_bands = static_cast<int>(1 + dice.below(4));
        if (!dice.often()) {
            tiling.along = Tiling::Along::rows;
        } else if (!grid.linked && dice.below(2) == 0) {
            tiling.along = Tiling::Along::columns;
            tiling.outer_layer *= PlaneLayout::row_pad;
        }
        EXPECT_TRUE(plain == steps_of(system, tiling, threads))
            << "seed " << seed << ", " << threads << " threads, " << tiling.levels << " levels of "
            << tiling.outer_layer << ", " << tiling.inner_bands << " bands of "
            << tiling.inner_layer << ", along " << static_cast<int>(tiling.along) << ", grid "
            << grid.width << " x " << grid.height << " x " << grid.depth;
        if (threads > 2) continue;
        // Parts that are as narrow as their halos.
        const int parts = 1 + threads;
        EXPECT_TRUE(plain == steps_of(system, tiling, 1, in_parts(parts, 1)))
            << "seed " << seed << ", " << parts << " parts, " << tiling.levels << " levels of "
            << tiling.outer_layer << ", along " << static_cast<int>(tiling.along) << ", grid "
            << grid.width << " x " << grid.height << " x " << grid.depth;
    }
}

void compare_both(const Grid& grid, std::uint64_t seed) {
    if (seed % 3 == 0) {
        compare<double>(grid, seed);
    } else {
        compare<float>(grid, seed);
    }
}

Boundaries boundary_of(std::uint64_t seed) {
    const auto along = [&](std::uint64_t bit) {
        return seed >> bit & 1 ? Boundary::periodic : Boundary::no_flux;
    };
    return {along(0), along(1), along(2)};
}

TEST(TiledSteps, OnSmallGrids) {
    const std::vector<GridSize> sizes{{1, 1, 1},   {1, 37, 1},  {41, 1, 1},  {16, 2, 1}, {13, 3, 1},
                                      {48, 23, 1}, {80, 31, 1}, {97, 29, 1}, {7, 5, 2},  {9, 11, 7},
                                      {5, 23, 13}, {1, 9, 6},   {33, 40, 4}};
    std::uint64_t seed = 1;
    for (const GridSize& size : sizes) {
        for (int repetition = 0; repetition < 6; ++repetition, ++seed) {
            compare_both({size.width, size.height, boundary_of(seed), size.depth}, seed);
            if (HasFailure()) return;
        }
    }
}

// If a grid has few rows, a layer is a group of neighbouring columns in all rows. Here the last
// layer is narrower than the others, and some vectors of cells are not full.
TEST(TiledSteps, OnFewLongRows) {
    const std::vector<GridSize> sizes{{1009, 1, 1}, {768, 1, 1}, {611, 2, 1},
                                      {523, 7, 1},  {64, 1, 1},  {409, 2, 3}};
    std::uint64_t seed = 1300;
    for (const GridSize& size : sizes) {
        for (int repetition = 0; repetition < 8; ++repetition, ++seed) {
            compare_both({size.width, size.height, boundary_of(seed), size.depth}, seed);
            if (HasFailure()) return;
        }
    }
}

TEST(TiledSteps, OnSeveralThreads) {
    const std::vector<GridSize> sizes{{192, 211, 1}, {1024, 97, 1}, {41, 37, 43}, {16, 1201, 1}};
    std::uint64_t seed = 500;
    for (const GridSize& size : sizes) {
        for (int repetition = 0; repetition < 4; ++repetition, ++seed) {
            compare_both({size.width, size.height, boundary_of(seed), size.depth}, seed);
            if (HasFailure()) return;
        }
    }
}

TEST(TiledSteps, OnLinkedCells) {
    std::uint64_t seed = 900;
    for (const GridSize& size :
         {GridSize{16, 50}, GridSize{64, 40}, GridSize{512, 90}, GridSize{32, 1}}) {
        for (int repetition = 0; repetition < 4; ++repetition, ++seed) {
            Grid grid{size.width, size.height};
            grid.linked = true;
            compare_both(grid, seed);
            if (HasFailure()) return;
        }
    }
}

}  // namespace
}  // namespace cascade::test
