// On a model, fields have the order of memory, which is fastest for steps. They are converted to
// the order in which files list the cells.
#include "run/pictures/array_moments.h"

#include "core/enough_memory.h"
#include "picture/float_bytes.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace cascade {

ArrayMoment array_moment(const Simulation& simulation) {
    const std::uint32_t stage = shown_stage(simulation);
    return {stage, simulation.domain().program->stages[stage].name, simulation.state(stage).steps,
            time_of(simulation, stage), time_since_start(simulation)};
}

std::vector<std::int64_t> sides_of_cells(const Simulation& simulation) {
    if (const auto model = simulation.domain().shared_model())
        return {static_cast<std::int64_t>(model->count())};
    const Grid& grid = simulation.domain().grid;
    if (grid.depth > 1) return {grid.depth, grid.height, grid.width};
    if (grid.height > 1) return {grid.height, grid.width};
    return {grid.width};
}

void append_cells(std::string& bytes, const Field& field, const Simulation& simulation) {
    const auto model = simulation.domain().shared_model();
    if (!field.empty() && !model) return append_floats(bytes, field);
    std::size_t cells = 1;
    for (const std::int64_t side : sides_of_cells(simulation)) {
        cells *= static_cast<std::size_t>(side);
    }
    const std::vector<double> values =
        field.empty() ? std::vector<double>(cells, std::numeric_limits<double>::quiet_NaN())
                      : cell_values(field, *model);
    with_number(simulation.domain().program->domain.precision, [&](auto zero) {
        for (const double value : values) {
            append_number(bytes, static_cast<decltype(zero)>(value));
        }
    });
}

Result<std::unique_ptr<GrowingFile>> begin_growing(const std::filesystem::path& path,
                                                   std::string_view bytes) {
    auto file = GrowingFile::create(path);
    if (!file) return file;
    if (auto done = (*file)->append(bytes); !done) return tl::unexpected(done.error());
    return file;
}

ArraySeries::ArraySeries(std::filesystem::path path, SeriesFields fields)
    : path_(std::move(path)), fields_(std::move(fields)) {}

void ArraySeries::add(const Simulation& simulation) {
    if (failure_) return;
    const auto added = enough_memory_for(
        [&] { return add_moment(simulation); },
        fmt::format("cannot write '{}': there is not enough memory", path_.string()));
    if (!added) failure_ = added.error();
    else ++moments_;
}

Result<WrittenSeries> ArraySeries::finish() {
    if (failure_) return tl::unexpected(*failure_);
    if (moments_ == 0) {
        return failure(fmt::format("'{}' has no moments, because the run took no step",
                                   path_.string()),
                       "a moment is written at the start of a stage and at each 'interval'");
    }
    if (auto done = complete(); !done) return tl::unexpected(done.error());
    return WrittenSeries{files_of_series(path_), 0};
}

}  // namespace cascade
