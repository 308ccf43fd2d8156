// Writes branches as JSON for the answer of --json.
#include "run/commands/follow_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace cascade {

std::string FollowTable::json(const std::vector<continuation::Branch>& branches) const {
    using Json = nlohmann::ordered_json;
    const auto number = [](double value) {
        return std::isfinite(value) ? Json(value) : Json(nullptr);
    };
    Json all = Json::array();
    for (const continuation::Branch& branch : branches) {
        Json& object = all.emplace_back(Json::object());
        object["from"] = nullptr;
        if (branch.from) {
            object["from"] = {{"branch", branch.from->first + 1},
                              {"point", branch.from->second + 1}};
        }
        object["begins"] = branch.from
                               ? fmt::format("at point {} of branch {}", branch.from->second + 1,
                                             branch.from->first + 1)
                               : branch.begins;
        object["ends"] = branch.ends;
        object["points"] = Json::array();
        for (const continuation::Point& point : branch.points) {
            Json& row = object["points"].emplace_back(Json::object());
            const bool is_special = point.kind != continuation::PointKind::regular;
            row["kind"] = is_special ? Json(word_of(point.kind)) : Json(nullptr);
            row["parameter"] = number(point.place.parameter);
            const std::vector<double> values = measured(point.place.state);
            for (std::size_t k = 0; k < values.size(); ++k) row[numbers_[k]] = number(values[k]);
            const bool is_known = point.growing && !point.leading.empty();
            row["growing"] = is_known ? Json(*point.growing) : Json(nullptr);
            row["rate"] = is_known ? number(point.leading[0].real()) : Json(nullptr);
            row["frequency"] = is_known ? number(std::abs(point.leading[0].imag())) : Json(nullptr);
            if (point.kind == continuation::PointKind::branch) {
                row["passing"] = point.crossing;
                row["vanishes"] = point.vanishes;
            }
        }
    }
    return all.dump();
}

}  // namespace cascade
