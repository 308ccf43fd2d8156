// A file gets its name when the first moment is added. For each further moment, first the data is
// appended, and then the length in the header is updated. So the file is valid at any time.
#include "run/pictures/array_series.h"

#include "core/csv.h"
#include "core/growing_file.h"
#include "picture/npy.h"
#include "run/pictures/array_moments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

namespace {

using Json = nlohmann::ordered_json;

class NpySeries : public ArraySeries {
public:
    using ArraySeries::ArraySeries;

private:
    Result<void> add_moment(const Simulation& simulation) override {
        const std::vector<std::int64_t> sides = sides_of_cells(simulation);
        std::string bytes;
        for (const Field& field : values(simulation)) append_cells(bytes, field, simulation);
        const std::string entry = json(array_moment(simulation));
        if (!array_) return begin(simulation, sides, bytes, entry);
        if (auto done = array_->append(bytes); !done) return done;
        const std::string head = (moments() > 0 ? ",\n" : "\n") + entry;
        if (auto done = list_->replace_end(list_->size() - end_of_list.size(),
                                           head + std::string(end_of_list));
            !done) {
            return done;
        }
        return array_->overwrite(0, header(moments() + 1));
    }

    Result<void> begin(const Simulation& simulation, const std::vector<std::int64_t>& sides,
                       const std::string& bytes, const std::string& entry) {
        type_ = fmt::format("<f{}", bytes_of(simulation.domain().program->domain.precision));
        shape_ = names().size() > 1 ? fmt::format("{}, ", names().size()) : "";
        shape_ += fmt::format("{}", fmt::join(sides, ", "));
        auto array = begin_growing(path(), header(1) + bytes);
        if (!array) return tl::unexpected(array.error());
        auto list = begin_growing(files_of_series(path())[1], describe(simulation, sides) + "\n" +
                                                                  entry + std::string(end_of_list));
        if (!list) return tl::unexpected(list.error());
        array_ = *std::move(array);
        list_ = *std::move(list);
        auto done = array_->appear();
        return done ? list_->appear() : done;
    }

    Result<void> complete() override {
        auto done = array_->complete();
        return done ? list_->complete() : done;
    }

    std::string header(std::int64_t count) const {
        const std::string shape = fmt::format("{}, {}", count, shape_);
        constexpr std::size_t longest = 40 + std::numeric_limits<std::int64_t>::digits10;
        return npy_head(type_, shape, longest - fmt::formatted_size("{}", count));
    }

    /// Writes NAME.json up to the list of moments.
    std::string describe(const Simulation& simulation,
                         const std::vector<std::int64_t>& sides) const {
        std::vector<std::string> axes = {"slice", "row", "column"};
        axes.erase(axes.begin(), axes.end() - static_cast<std::ptrdiff_t>(sides.size()));
        if (simulation.domain().shared_model()) axes = {"cell"};
        if (names().size() > 1) axes.insert(axes.begin(), "field");
        axes.insert(axes.begin(), "time");
        Json all = {{"array", path().filename().string()},
                    {"type", type_},
                    {"axes", axes},
                    {"fields", names()}};
        const DomainSettings& domain = simulation.domain().program->domain;
        if (!domain.model && !domain.surface) all["spacing"] = domain.grid.spacing;
        std::string text = "{\n";
        for (const auto& [key, value] : all.items()) {
            text += fmt::format(" \"{}\": {},\n", key, written(value));
        }
        return text + " \"moments\": [";
    }

    static std::string json(const ArrayMoment& moment) {
        const auto number = [](double value) {
            return std::isfinite(value) ? Json(value) : Json(nullptr);
        };
        return "  " + written({{"stage", moment.stage_name},
                               {"step", moment.step},
                               {"t", number(moment.t)},
                               {"time", number(moment.time)}});
    }

    /// Writes JSON. Bytes of file names that are not UTF-8 are replaced.
    static std::string written(const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    static constexpr std::string_view end_of_list = "\n ]\n}\n";

    /// The type of the elements, and the sizes of the axes other than time, in the words of the
    /// header.
    std::string type_, shape_;
    std::unique_ptr<GrowingFile> array_, list_;
};

class CsvSeries : public ArraySeries {
public:
    using ArraySeries::ArraySeries;

private:
    Result<void> add_moment(const Simulation& simulation) override {
        const ArrayMoment moment = array_moment(simulation);
        const Precision precision = simulation.domain().program->domain.precision;
        std::vector<std::string> cells = {moment.stage_name, fmt::format("{}", moment.step),
                                          csv_number(moment.t, precision)};
        for (const Field& field : values(simulation)) {
            for (std::int64_t i = 0; i < simulation.domain().grid.width; ++i) {
                cells.push_back(field.empty() ? "" : csv_number(field.number_at(i, 0), precision));
            }
        }
        if (file_) return file_->append(csv_row(cells));
        auto file = begin_growing(path(), head(simulation.domain().grid) + csv_row(cells));
        if (!file) return tl::unexpected(file.error());
        file_ = *std::move(file);
        return file_->appear();
    }

    std::string head(const Grid& grid) const {
        std::vector<std::string> columns = {"stage", "step", "t"};
        for (const std::string& name : names()) {
            for (std::int64_t i = 0; i < grid.width; ++i) {
                const double middle = (static_cast<double>(i) + 0.5) * grid.spacing;
                columns.push_back(fmt::format("{}({:.9g})", name, middle));
            }
        }
        return csv_row(columns);
    }

    Result<void> complete() override { return file_->complete(); }

    std::unique_ptr<GrowingFile> file_;
};

template <typename Series>
Result<std::unique_ptr<SeriesWriter>> make(const std::filesystem::path& path, SeriesFields fields) {
    for (const auto& file : files_of_series(path)) {
        if (auto can = check_can_grow(file); !can) return tl::unexpected(can.error());
    }
    return std::make_unique<Series>(path, std::move(fields));
}

}  // namespace

Result<std::unique_ptr<SeriesWriter>> make_npy_series(const std::filesystem::path& path,
                                                      SeriesFields fields) {
    return make<NpySeries>(path, std::move(fields));
}

Result<std::unique_ptr<SeriesWriter>> make_csv_series(const std::filesystem::path& path,
                                                      SeriesFields fields) {
    return make<CsvSeries>(path, std::move(fields));
}

}  // namespace cascade
