// Writes the overlays of a pattern of Ready as starting values.
//
// An overlay changes a chemical inside its shapes by an operation and a fill. Overlays are applied
// in order. Positions are fractions of the domain. Ready compares positions with the corners of
// cells, so shapes are moved here such that they contain the same cells.
#include "import/ready.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::importing {

namespace {

using Point = std::array<double, 3>;

class ReadyStart {
public:
    ReadyStart(ReadyPattern& pattern, const std::vector<std::string>& stored, Draft& draft)
        : pattern_(pattern), draft_(draft) {
        for (const std::string& each : stored) {
            values_.push_back(plain_number(each) ? number(*plain_number(each)) : name(each));
        }
    }

    bool add(const pugi::xml_node& overlay) {
        const auto species =
            ready_chemical_number(overlay.attribute("chemical").value(), pattern_.species.size());
        if (!species) return true;  // Ready also ignores overlays of unknown chemicals.
        std::string sign;
        pugi::xml_node fill;
        std::vector<pugi::xml_node> shapes;
        for (const pugi::xml_node& part : overlay.children()) {
            if (part.type() != pugi::node_element) continue;
            const std::string_view kind = part.name();
            if (const auto found = sign_of(kind); !found.empty()) {
                sign = found;
            } else if (kind == "everywhere" || kind == "rectangle" || kind == "circle" ||
                       kind == "pixel") {
                shapes.push_back(part);
            } else {
                fill = part;
            }
        }
        if (sign.empty() || !fill || shapes.empty()) {
            return fail(overlay, "an overlay needs an operation, a fill and a shape");
        }
        for (const pugi::xml_node& shape : shapes) {
            const auto inside = shape_of(shape);
            const auto value = fill_of(fill, *species);
            if (failed_) return false;
            if (inside) apply(values_[*species], sign, *inside, *value);
        }
        return !failed_;
    }

    void finish() {
        for (std::size_t k = 0; k < values_.size(); ++k) {
            draft_.starts.push_back(
                fmt::format("{}: {}", pattern_.species[k], write_formula(values_[k])));
        }
    }

private:
    static std::string sign_of(std::string_view operation) {
        constexpr std::pair<std::string_view, std::string_view> signs[] = {{"overwrite", "="},
                                                                           {"add", "+"},
                                                                           {"subtract", "-"},
                                                                           {"multiply", "*"},
                                                                           {"divide", "/"}};
        for (const auto& [name, sign] : signs) {
            if (name == operation) return std::string(sign);
        }
        return "";
    }

    /// Changes a value inside a shape. If the shape contains all cells, `inside` is the number 1.
    static void apply(Expression& value, const std::string& sign, const Expression& inside,
                      const Expression& fill) {
        const bool is_everywhere = inside.is_number("1");
        if (sign == "=") {
            value = is_everywhere ? fill : call("if", {inside, fill, value});
            return;
        }
        const Expression nothing = number(sign == "+" || sign == "-" ? 0 : 1);
        value = operation(value, sign, is_everywhere ? fill : call("if", {inside, fill, nothing}));
    }

    bool fail(const pugi::xml_node& node, std::string why) {
        pattern_.import.diagnostics.error(place_of(pattern_.import, node), std::move(why));
        failed_ = true;
        return false;
    }

    double attribute(const pugi::xml_node& node, const char* wanted) {
        const auto value = number_attribute(pattern_.import, node, wanted);
        if (!value) failed_ = true;
        return value.value_or(0);
    }

    /// Reads the points that the children of an element give. Reports an error unless there are
    /// `count`.
    std::vector<Point> points_of(const pugi::xml_node& node, std::size_t count) {
        std::vector<Point> points;
        for (const pugi::xml_node& point : node.children()) {
            if (point.type() != pugi::node_element) continue;
            points.push_back({attribute(point, "x"), attribute(point, "y"), attribute(point, "z")});
        }
        if (points.size() != count) {
            fail(node, fmt::format("<{}> needs {} points", plain_line(node.name()), count));
            points.resize(count);
        }
        return points;
    }

    bool exists(std::size_t axis) const { return pattern_.cells[axis] > 1; }

    /// The position `at` along an axis, counted in cells from the corner of Ready's first cell, as
    /// a coordinate of Cascade: "128.5/256" for the middle of the cell 128.
    Expression coordinate(std::size_t axis, double at) const {
        const double middle = at + 0.5;
        const double place = axis == 1 ? static_cast<double>(pattern_.cells[1]) - middle : middle;
        const auto longest = static_cast<double>(pattern_.longest());
        const Expression quotient = operation(number(place), "/", number(longest));
        const double value = place / longest;
        return value * 1000 == std::floor(value * 1000) ? number(value) : quotient;
    }

    /// The condition that a cell is inside a shape. Empty if no cell is inside.
    std::optional<Expression> shape_of(const pugi::xml_node& node) {
        const std::string_view kind = node.name();
        if (kind == "everywhere") return number(1);
        if (kind == "circle") return circle(node);
        Point low{}, high{};
        if (kind == "pixel") {
            low = high = {attribute(node, "x"), attribute(node, "y"), attribute(node, "z")};
        } else {
            const auto points = points_of(node, 2);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto count = static_cast<double>(pattern_.cells[axis]);
                low[axis] = std::ceil(points[0][axis] * count - 1e-9);
                high[axis] = std::floor(points[1][axis] * count + 1e-9);
            }
        }
        return box(low, high);
    }

    /// The condition that a cell is in the box from `low` to `high`.
    std::optional<Expression> box(Point low, Point high) const {
        std::vector<Expression> middle, sizes;
        const auto longest = static_cast<double>(pattern_.longest());
        bool is_all = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!exists(axis)) {
                if (axis < 2) {
                    middle.push_back(number(0.5));
                    sizes.push_back(number(2));
                }
                continue;
            }
            const auto last = static_cast<double>(pattern_.cells[axis] - 1);
            if (high[axis] < 0 || low[axis] > last || high[axis] < low[axis]) return std::nullopt;
            const bool is_whole_axis = low[axis] <= 0 && high[axis] >= last;
            if (!is_whole_axis) is_all = false;
            low[axis] = std::max(low[axis], 0.0);
            high[axis] = std::min(high[axis], last);
            middle.push_back(coordinate(axis, (low[axis] + high[axis]) / 2));
            sizes.push_back(is_whole_axis ? number(2)
                                          : operation(number(high[axis] - low[axis] + 1), "/",
                                                      number(longest)));
        }
        if (is_all) return number(1);
        middle.insert(middle.end(), sizes.begin(), sizes.end());
        return call("box", std::move(middle));
    }

    Expression circle(const pugi::xml_node& node) {
        const Point centre = points_of(node, 1)[0];
        const double radius = attribute(node, "radius");
        std::vector<Expression> arguments, squares;
        bool crosses = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto count = static_cast<double>(pattern_.cells[axis]);
            const double reach = radius * static_cast<double>(pattern_.longest());
            if (!exists(axis)) {
                if (axis < 2) arguments.push_back(number(0.5));
                continue;
            }
            const Expression place = coordinate(axis, centre[axis] * count);
            arguments.push_back(place);
            squares.push_back(square(axis, place));
            crosses |= centre[axis] * count - reach < 0 || centre[axis] * count + reach >= count;
        }
        arguments.push_back(number(radius));
        if (!pattern_.is_periodic || !crosses) return call("disc", std::move(arguments));
        // A disc of Cascade continues at periodic sides, but a circle of Ready does not.
        return operation(root(std::move(squares)), "<", number(radius));
    }

    /// (x - place)^2
    Expression square(std::size_t axis, Expression place) const {
        return operation(operation(name(std::string(1, "xyz"[axis])), "-", std::move(place)), "^",
                         number(2));
    }
    static Expression sum(std::vector<Expression> terms) {
        Expression all = number(0);
        for (Expression& each : terms) all = operation(std::move(all), "+", std::move(each));
        return all;
    }
    static Expression root(std::vector<Expression> terms) {
        return call("sqrt", {sum(std::move(terms))});
    }

    /// The squares of the distances from a point along the axes that exist.
    std::vector<Expression> squares_from(const Point& point) const {
        std::vector<Expression> squares;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!exists(axis)) {
                const double apart = point[axis] / static_cast<double>(pattern_.longest());
                if (apart != 0) squares.push_back(number(apart * apart));
                continue;
            }
            squares.push_back(square(
                axis, coordinate(axis, point[axis] * static_cast<double>(pattern_.cells[axis]))));
        }
        return squares;
    }

    /// The fraction of the way from the first point to the second, as a formula of the position.
    Expression way(const std::vector<Point>& points, const pugi::xml_node& node) {
        double length2 = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            length2 += std::pow(points[1][axis] - points[0][axis], 2);
        }
        if (length2 == 0) fail(node, "the two points are the same");
        std::vector<Expression> terms;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double factor = (points[1][axis] - points[0][axis]) / length2;
            if (factor == 0) continue;
            if (!exists(axis)) {
                terms.push_back(number(-points[0][axis] * factor));
                continue;
            }
            const auto count = static_cast<double>(pattern_.cells[axis]);
            // In Ready, fractions of the side are x_pos = sx - 0.5/W and y_pos = 1 - sy - 0.5/H.
            const double origin = points[0][axis] + 0.5 / count;
            const Expression place = name(fmt::format("s{}", "xyz"[axis]));
            const Expression from = axis == 1 ? operation(number(1 - origin), "-", place)
                                              : operation(place, "-", number(origin));
            terms.push_back(operation(number(factor), "*", from));
        }
        return sum(std::move(terms));
    }

    std::optional<Expression> fill_of(const pugi::xml_node& node, std::size_t species) {
        const std::string_view kind = node.name();
        if (kind == "constant") return number(attribute(node, "value"));
        if (kind == "white_noise") {
            const double low = attribute(node, "low"), high = attribute(node, "high");
            return call("random", {number((low + high) / 2), number((high - low) / 2)});
        }
        if (kind == "parameter") return parameter(node);
        if (kind == "other_chemical") return other_chemical(node);
        if (kind == "perlin_noise") return perlin_noise(node);
        if (kind == "gaussian") {
            const Point centre = points_of(node, 1)[0];
            const double sigma = attribute(node, "sigma");
            const Expression exponent =
                operation(sum(squares_from(centre)), "/", number(2 * sigma * sigma));
            return operation(number(attribute(node, "height")), "*",
                             call("exp", {negated(exponent)}));
        }
        if (kind == "sine") {
            const Expression phase = number(attribute(node, "phase"));
            const Expression angle = operation(operation(number(2), "*", name("pi")), "*",
                                               way(points_of(node, 2), node));
            return operation(number(attribute(node, "amplitude")), "*",
                             call("sin", {operation(angle, "-", phase)}));
        }
        if (kind == "linear_gradient" || kind == "radial_gradient") return gradient(node);
        fail(node, fmt::format("the fill <{}> of chemical '{}' is unknown", plain_line(kind),
                               ready_chemical(species)));
        return std::nullopt;
    }

    Expression gradient(const pugi::xml_node& node) {
        const auto points = points_of(node, 2);
        const double from = attribute(node, "val1"), to = attribute(node, "val2");
        Expression part = way(points, node);
        if (std::string_view(node.name()) == "radial_gradient") {
            double length2 = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                length2 += std::pow((points[1][axis] - points[0][axis]) *
                                        static_cast<double>(pattern_.cells[axis]) /
                                        static_cast<double>(pattern_.longest()),
                                    2);
            }
            part = operation(root(squares_from(points[0])), "/", number(std::sqrt(length2)));
        }
        return operation(number(from), "+", operation(number(to - from), "*", part));
    }

    Expression parameter(const pugi::xml_node& node) {
        const std::string wanted = unescaped(node.attribute("name").value());
        if (wanted == "timestep") return name("speed");
        if (wanted == "dx") return name("domain.spacing");
        const auto found = pattern_.parameters.find(wanted);
        if (found != pattern_.parameters.end()) return name(found->second);
        fail(node, fmt::format("there is no parameter '{}'", plain_line(wanted)));
        return {};
    }

    /// The present value of another chemical. A value that draws random numbers becomes a separate
    /// parameter, so that both chemicals have the same draw.
    Expression other_chemical(const pugi::xml_node& node) {
        const auto other =
            ready_chemical_number(node.attribute("chemical").value(), pattern_.species.size());
        if (!other) {
            fail(node, "there is no such chemical");
            return {};
        }
        Expression& value = values_[*other];
        if (write_formula(value).size() > 12) {
            const std::string shared = pattern_.names.fresh(pattern_.species[*other] + "_start");
            draft_.parameters.push_back(fmt::format("{}: {}", shared, write_formula(value)));
            value = name(shared);
        }
        return value;
    }

    Expression perlin_noise(const pugi::xml_node& node) {
        const double scale = node.attribute("scale").as_double(64);
        const double octaves = node.attribute("num_octaves").as_double(8);
        if (!(scale > 0) || octaves < 1) {
            fail(node, "a scale above 0 and at least one octave are expected");
            return {};
        }
        const std::string remark =
            "Ready's Perlin noise becomes noise(…), whose hills have the same width but other "
            "positions.";
        if (std::find(draft_.remarks.begin(), draft_.remarks.end(), remark) ==
            draft_.remarks.end()) {
            draft_.remarks.push_back(remark);
        }
        const Expression hills =
            call("noise", {number(scale / static_cast<double>(pattern_.longest())),
                           number(std::min(std::floor(octaves), 12.0))});
        const Expression middle = operation(number(0.5), "+", operation(number(0.5), "*", hills));
        return call("clamp", {middle, number(0), number(1)});
    }

    ReadyPattern& pattern_;
    Draft& draft_;
    std::vector<Expression> values_;
    bool failed_ = false;
};

}  // namespace

bool add_ready_start(ReadyPattern& pattern, const pugi::xml_node& generator,
                     const std::vector<std::string>& stored, Draft& draft) {
    constexpr std::size_t most_overlays = 300;
    ReadyStart start(pattern, stored, draft);
    std::size_t count = 0;
    for (const pugi::xml_node& overlay : generator.children("overlay")) {
        if (++count > most_overlays) {
            pattern.import.diagnostics.error(place_of(pattern.import, overlay),
                                             fmt::format("there are more than {} overlays",
                                                         most_overlays));
            return false;
        }
        if (!start.add(overlay)) return false;
    }
    start.finish();
    return true;
}

}  // namespace cascade::importing
