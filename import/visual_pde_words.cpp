// The meaning of single names in formulas of VisualPDE: species, derivatives, positions, noise,
// pictures.
#include "import/visual_pde.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::importing {

std::optional<Expression> VisualPdeNames::named(const Expression& part, Where where) {
    const std::string& word = part.text;
    if (const auto found = own_species_.find(word); found != own_species_.end()) {
        if (where == Where::start) fail(part.span, "a starting value cannot read a species");
        return name(found->second);
    }
    for (Parameter& each : parameters_) {
        if (each.foreign != word) continue;
        if (where != Where::mask) {
            each.is_read = true;
            return name(each.own);
        }
        // Masks cannot read parameters, so the formulas of parameters are written in place of their
        // names.
        if (++depth_ > 20) fail(part.span, "these parameters depend on each other");
        auto value = has_failed_ ? std::nullopt : formula(each.value, Where::mask);
        --depth_;
        return value ? value : number(0);
    }
    if (word == "x" || word == "y") return place(word[0]);
    if (word == "t") {
        return where == Where::start ? number(0) : name("t");
    }
    if (word == "L_x" || word == "L") return name("domain.width");
    if (word == "L_y") return name(is_line_ ? "domain.width" : "domain.height");
    if (word == "L_min") return name("domain.width");
    if (word == "dx" || word == "dy") return name("domain.spacing");
    if (word == "dt") return name("speed");
    if (word == "pi") return name("pi");
    if ((word == "exterior" || word == "interior") && !is_line_) return on_edge(word == "exterior");
    if (word == "MINX") return option("minX", Where::mask);
    if (word == "MINY") return option("minY", Where::mask);
    if (word.starts_with("RANDN")) return call("normal", {number(0), number(1)});
    if (word.starts_with("RAND")) return call("random", {number(0.5), number(0.5)});
    if (word.starts_with("WhiteNoise")) return call("white", {number(1)});
    if (word == "GlobalInt") {
        const auto inside = option("globalIntegralFun", Where::rate);
        if (!inside) return std::nullopt;
        Expression counted = *inside;
        if (!inside_.empty()) counted = call("if", {name(inside_), counted, number(0)});
        return name(fmt::format("integral({} over domain)", write_formula(counted)));
    }
    if (word.starts_with("I_S") || word.starts_with("I_T")) return picture(part, where);
    return derivative(word);
}

/// If `is_outer`, the condition that the cell is one of the outermost cells, otherwise the
/// condition that it is not.
Expression VisualPdeNames::on_edge(bool is_outer) {
    Expression all;
    for (const char* const axis : {"domain.x", "domain.y"}) {
        const Expression size =
            name(axis == std::string_view("domain.x") ? "domain.width" : "domain.height");
        const Expression far = operation(size, "-", name("domain.spacing"));
        const Expression either = operation(operation(name(axis), "<", name("domain.spacing")),
                                            "or", operation(name(axis), ">", far));
        all = all.is_number("0") ? either : operation(all, "or", either);
    }
    if (is_outer) return all;
    return operation(number(1), "-", all);
}

/// A derivative: u_x, u_yy, u_xb (backward), u_xf2 (forward, of second order).
std::optional<Expression> VisualPdeNames::derivative(const std::string& word) {
    const std::size_t line = word.rfind('_');
    if (line == std::string::npos) return std::nullopt;
    const auto found = own_species_.find(word.substr(0, line));
    const std::string kind = word.substr(line + 1);
    if (found == own_species_.end() || kind.empty()) return std::nullopt;
    const std::string& species = found->second;
    const char axis = kind[0];
    if (axis != 'x' && axis != 'y') return std::nullopt;
    if (kind == "x") return operate("dx", species);
    if (kind == "y") return negated(operate("dy", species));
    if (kind == "xx" || kind == "yy") return operate("d" + kind, species);
    if (kind == "xy" || kind == "yx") return negated(operate("dxy", species));
    const bool is_forward = kind.size() > 1 && kind[1] == 'f';
    if (kind.size() < 2 || (kind[1] != 'f' && kind[1] != 'b')) return std::nullopt;
    const Expression u = name(species), h = name("domain.spacing");
    const auto beside = [&](int cells) {
        const int by = is_forward ? cells : -cells;
        return axis == 'x' ? shifted(species, by, 0) : shifted(species, 0, by);
    };
    const Expression next = beside(1);
    if (kind.size() == 2) {
        return operation(is_forward ? operation(next, "-", u) : operation(u, "-", next), "/", h);
    }
    if (kind.substr(2) != "2") return std::nullopt;
    Expression difference =
        operation(operation(operation(number(3), "*", u), "-", operation(number(4), "*", next)),
                  "+", beside(2));
    if (is_forward) difference = negated(std::move(difference));
    return operation(std::move(difference), "/", operation(number(2), "*", h));
}

/// The value u[x + dx, y] in a cell at a whole number of cells from this one.
std::optional<Expression> VisualPdeNames::at_other_cell(const Expression& part) {
    const auto found = own_species_.find(part.text.substr(0, part.text.size() - 1));
    if (found == own_species_.end() || part.of.size() != 2) {
        fail(part.span, "a species at two coordinates is expected here");
        return std::nullopt;
    }
    int cells[2] = {0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
        // The argument is the position plus an offset, which is computed as the value of the
        // argument minus the position.
        const char axis = k == 0 ? 'x' : 'y';
        const Expression offset =
            replaced(operation(part.of[k], "-", place(axis)),
                     [&](const Expression& inner) { return number_for(inner, 0, 0); });
        const bool has_place = mentions(part.of[k], axis == 'x' ? "domain.x" : "domain.y");
        const auto distance = value_of(offset);
        const double shift = distance ? *distance / spacing : 0.5;
        if (!has_place || std::abs(shift - std::round(shift)) > 1e-6 || std::abs(shift) > 8) {
            fail(part.span,
                 "only values of cells that are at most 8 whole cells away can be "
                 "imported");
            return std::nullopt;
        }
        cells[k] = static_cast<int>(std::round(shift));
    }
    if (cells[0] == 0 && cells[1] == 0) return name(found->second);
    return shifted(found->second, cells[0], cells[1]);
}

/// The value of a name in a formula of positions, at the point (x, y) from the upper left corner.
std::optional<Expression> VisualPdeNames::number_for(const Expression& part, double x,
                                                     double y) const {
    if (part.is_name("domain.x")) return number(x);
    if (part.is_name("domain.y")) return number(y);
    if (part.is_name("domain.width")) return number(width);
    if (part.is_name("domain.height")) return number(height);
    if (part.is_name("domain.spacing")) return number(spacing);
    const auto known = values_.find(part.text);
    return known == values_.end() ? std::nullopt : std::optional(number(known->second));
}

/// The position in a picture from 0 to 1, for a coordinate that grows evenly with x or with y.
std::optional<std::string> VisualPdeNames::place_in_picture(const Expression& at, char axis) {
    const double size = axis == 'x' ? width : height;
    const auto share = [&](double sx, double sy) -> std::optional<double> {
        const auto number_of = [&](const Expression& part) {
            return number_for(part, sx * width, sy * height);
        };
        const auto least = option(axis == 'x' ? "minX" : "minY", Where::mask);
        const auto from = value_of(replaced(least.value_or(number(0)), number_of));
        const auto value = value_of(replaced(at, number_of));
        if (!value || !from) return std::nullopt;
        const double along = (*value - *from) / size;
        return axis == 'x' ? along : 1 - along;
    };
    const auto origin = share(0, 0), right = share(1, 0), down = share(0, 1), far = share(0.3, 0.7);
    if (!origin || !right || !down || !far) return std::nullopt;
    const double by_x = *right - *origin, by_y = *down - *origin;
    if (std::abs(*origin + 0.3 * by_x + 0.7 * by_y - *far) > 1e-6) return std::nullopt;
    const auto rounded = [](double value) { return std::round(value * 1e9) / 1e9; };
    Expression place = number(0);
    for (const double sign : {1.0, -1.0}) {
        for (const auto& [factor, of] : {std::pair(by_x, name("sx")), std::pair(by_y, name("sy")),
                                         std::pair(*origin, number(1))}) {
            if (!(rounded(factor) * sign > 0)) continue;
            const Expression term = operation(number(std::abs(rounded(factor))), "*", of);
            place = operation(std::move(place), sign > 0 ? "+" : "-", term);
        }
    }
    return write_formula(place);
}

/// I_S, I_TR, I_SA(x, y): the mean of a picture's colours or one of its channels, here or at
/// another place.
std::optional<Expression> VisualPdeNames::picture(const Expression& part, Where where) {
    const std::string& word = part.text;
    const bool is_second = word.starts_with("I_T");
    constexpr std::pair<char, std::string_view> channels[] = {
        {'R', "red"}, {'G', "green"}, {'B', "blue"}, {'A', "alpha"}};
    std::string channel;
    for (const auto& [letter, words] : channels) {
        if (word.size() == 4 && word[3] == letter) channel = words;
    }
    if ((word.size() != 3 && channel.empty()) || part.of.size() > 2) {
        fail(part.span, fmt::format("'{}' has no meaning here", word));
        return std::nullopt;
    }
    std::string at;
    if (!part.of.empty()) {
        const auto x = place_in_picture(part.of[0], 'x');
        const auto y = place_in_picture(part.of.size() == 2 ? part.of[1] : number(0), 'y');
        if (!x || !y) {
            fail(part.span,
                 "a picture can be read only at positions that are linear in x and y, such as (x "
                 "/ 2, y)");
            return std::nullopt;
        }
        if (*x != "sx" || *y != "sy") at = fmt::format(", {}, {}", *x, *y);
    }
    const std::string file = fmt::format("{}_{}.png", import_.stem, is_second ? "second" : "first");
    const auto image = [&](std::string_view of) {
        return fmt::format("image(\"{}\", \"{}\"{})", file, of, at);
    };
    const std::string value = !channel.empty() ? image(channel)
                                               : fmt::format("({} + {} + {}) / 3", image("red"),
                                                             image("green"), image("blue"));
    const std::string source =
        plain_line(options_.text(is_second ? "imagePathTwo" : "imagePathOne")).substr(0, 60);
    const std::string remark =
        fmt::format("The picture '{}' of VisualPDE must be saved as {} beside this script.", source,
                    file);
    auto& remarks = draft_.remarks;
    if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) {
        remarks.push_back(remark);
    }
    if (where == Where::mask) return name("(" + value + ")");  // Masks cannot read parameters.
    if (!pictures_.contains(value)) {
        pictures_[value] = names_.fresh(word);
        draft_.parameters.push_back(fmt::format("{}: {}", pictures_[value], value));
    }
    return name(pictures_[value]);
}

}  // namespace cascade::importing
