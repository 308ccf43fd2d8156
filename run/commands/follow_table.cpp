// Writes branches of steady states as rows, lines and words.
#include "run/commands/follow_table.h"

#include "core/counted.h"
#include "core/csv.h"
#include "run/commands/branch_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {

namespace {

using continuation::Branch;
using continuation::Point;
using continuation::PointKind;

constexpr std::array measures = {"norm", "min", "max", "mean"};

std::string exact(double value) { return csv_number(value, Precision::binary64); }

}  // namespace

std::string_view word_of(PointKind kind) {
    switch (kind) {
        case PointKind::fold: return "fold";
        case PointKind::branch: return "branch point";
        case PointKind::hopf: return "Hopf point";
        default: return "";
    }
}

FollowTable::FollowTable(const Program& program, std::uint32_t stage, ItemId varied,
                         continuation::Vector areas)
    : areas_(std::move(areas)) {
    const System& system = program.system_of(stage);
    name_of_varied_ = system.item_name(varied);
    for (const ItemId item : system.species()) {
        species_.emplace_back(system.item_name(item));
        for (const char* measure : measures) {
            numbers_.push_back(fmt::format("{}_{}", measure, species_.back()));
        }
    }
}

Result<std::size_t> FollowTable::find_number(std::string_view name) const {
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
        if (name == numbers_[k] || (k < measures.size() && name == measures[k])) return k;
    }
    return failure(fmt::format("there is no number '{}' of a state", name),
                   fmt::format("the numbers of a state are {}", fmt::join(numbers_, ", ")));
}

std::vector<double> FollowTable::measured(const continuation::Vector& state) const {
    const auto count = static_cast<continuation::Index>(species_.size());
    const continuation::Index cells = state.size() / count;
    std::vector<double> numbers;
    for (continuation::Index s = 0; s < count; ++s) {
        double squares = 0, sum = 0;
        double least = state[s], most = state[s];
        for (continuation::Index k = 0; k < cells; ++k) {
            const double value = state[k * count + s];
            squares += areas_[k] * value * value;
            sum += areas_[k] * value;
            least = std::min(least, value);
            most = std::max(most, value);
        }
        const double total = areas_.sum();
        numbers.insert(numbers.end(), {std::sqrt(squares / total), least, most, sum / total});
    }
    return numbers;
}

std::string FollowTable::csv(const std::vector<Branch>& branches) const {
    std::vector<std::string> head{"branch", "point", "kind", name_of_varied_};
    head.insert(head.end(), numbers_.begin(), numbers_.end());
    for (const char* name : {"stable", "growing", "rate", "frequency"}) head.emplace_back(name);
    std::string text = csv_row(head);
    for (std::size_t b = 0; b < branches.size(); ++b) {
        for (std::size_t k = 0; k < branches[b].points.size(); ++k) {
            const Point& point = branches[b].points[k];
            std::vector<std::string> row{std::to_string(b + 1), std::to_string(k + 1),
                                         std::string(word_of(point.kind)),
                                         exact(point.place.parameter)};
            for (const double number : measured(point.place.state)) row.push_back(exact(number));
            if (point.growing && !point.leading.empty()) {
                const auto& [rate, frequency] =
                    std::pair(point.leading[0].real(), point.leading[0].imag());
                row.insert(row.end(),
                           {*point.growing == 0 ? "1" : "0", std::to_string(*point.growing),
                            csv_number(rate), csv_number(std::abs(frequency))});
            } else {
                row.resize(head.size());
            }
            text += csv_row(row);
        }
    }
    return text;
}

std::string FollowTable::words(const std::vector<Branch>& branches) const {
    std::string text;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const Branch& branch = branches[b];
        text += fmt::format("branch {}: {}", b + 1, counted(branch.points.size(), "point"));
        if (branch.from) {
            text += fmt::format(", from point {} of branch {}", branch.from->second + 1,
                                branch.from->first + 1);
        }
        text += "\n";
        for (std::size_t k = 0; k < branch.points.size(); ++k) {
            const Point& point = branch.points[k];
            if (point.kind == PointKind::regular) continue;
            const std::string crossing =
                point.kind == PointKind::branch && point.crossing > 1
                    ? fmt::format(", {} at once", counted(point.crossing, "eigenvalue"))
                    : std::string();
            text += fmt::format("  point {}: {} at {} = {:.7g}, {} = {:.6g}{}\n", k + 1,
                                word_of(point.kind), name_of_varied_, point.place.parameter,
                                numbers_[0], measured(point.place.state)[0],
                                crossing + (point.vanishes ? ", where the pattern vanishes" : ""));
        }
        if (!branch.begins.empty()) {
            text += fmt::format("  begins at {} = {:.6g}: {}\n", name_of_varied_,
                                branch.points.front().place.parameter, branch.begins);
        }
        text += fmt::format("  ends at {} = {:.6g}: {}\n", name_of_varied_,
                            branch.points.back().place.parameter, branch.ends);
    }
    return text;
}

Drawing FollowTable::diagram(const std::vector<Branch>& branches, std::size_t number,
                             const std::string& title, const StatePictures& pictures) const {
    return draw_branches({*this, number, name_of_varied_, title}, branches, pictures);
}

}  // namespace cascade
