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
        if (where == Where::mask) {
            fail(part.span, "a mask that changes with a species has no counterpart");
        }
        if (where == Where::start) fail(part.span, "a starting value cannot read a species");
        return name(found->second);
    }
    for (Parameter& each : parameters_) {
        if (each.foreign != word) continue;
        if (where != Where::mask) {
            each.is_read = true;
            return name(each.own);
        }
        // Masks cannot read parameters, so the formulas of parameters are written in their place.
        if (++depth_ > 20) fail(part.span, "the parameters read each other");
        auto value = has_failed_ ? std::nullopt : formula(each.value, Where::mask);
        --depth_;
        return value ? value : number(0);
    }
    if (word == "x" || word == "y") return place(word[0]);
    if (word == "t") {
        if (where == Where::mask) fail(part.span, "a mask that moves with t has no counterpart");
        return where == Where::start ? number(0) : name("t");
    }
    if (word == "L_x" || word == "L") return name("domain.width");
    if (word == "L_y") return name(is_line_ ? "domain.width" : "domain.height");
    if (word == "L_min") return name("domain.width");
    if (word == "dx" || word == "dy") return name("domain.spacing");
    if (word == "dt") return name("speed");
    if (word == "pi") return name("pi");
    if (word == "MINX") return option("minX", Where::mask);
    if (word == "MINY") return option("minY", Where::mask);
    if (word.starts_with("RANDN")) return call("normal", {number(0), number(1)});
    if (word.starts_with("RAND")) return call("random", {number(0.5), number(0.5)});
    if (word.starts_with("WhiteNoise")) return call("white", {number(1)});
    if (word == "GlobalInt") {
        const auto inside = option("globalIntegralFun", Where::rate);
        if (!inside) return std::nullopt;
        return name(fmt::format("integral({} over domain)", write_formula(*inside)));
    }
    if (word.starts_with("I_S") || word.starts_with("I_T")) return picture(part, where);
    return derivative(word);
}

/// u_x, u_yy, u_xb (backward), u_xf2 (forward, of second order).
std::optional<Expression> VisualPdeNames::derivative(const std::string& word) {
    const std::size_t line = word.rfind('_');
    if (line == std::string::npos) return std::nullopt;
    const auto found = own_species_.find(word.substr(0, line));
    const std::string kind = word.substr(line + 1);
    if (found == own_species_.end() || kind.empty()) return std::nullopt;
    const Expression u = name(found->second);
    differentiate(found->second);
    const char axis = kind[0];
    if (axis != 'x' && axis != 'y') return std::nullopt;
    if (kind == "x") return call("dx", {u});
    if (kind == "y") return negated(call("dy", {u}));
    if (kind == "xx" || kind == "yy") return call("d" + kind, {u});
    if (kind == "xy" || kind == "yx") return negated(call("dxy", {u}));
    const bool is_forward = kind.size() > 1 && kind[1] == 'f';
    if (kind.size() < 2 || (kind[1] != 'f' && kind[1] != 'b')) return std::nullopt;
    const Expression h = name("domain.spacing");
    const Expression next = shifted(u, axis, is_forward ? 1 : -1);
    if (kind.size() == 2) {
        return operation(is_forward ? operation(next, "-", u) : operation(u, "-", next), "/", h);
    }
    if (kind.substr(2) != "2") return std::nullopt;
    const Expression after = shifted(u, axis, is_forward ? 2 : -2);
    Expression difference =
        operation(operation(operation(number(3), "*", u), "-", operation(number(4), "*", next)),
                  "+", after);
    if (is_forward) difference = negated(std::move(difference));
    return operation(std::move(difference), "/", operation(number(2), "*", h));
}

/// u[x + dx, y]: the value a whole number of cells away.
std::optional<Expression> VisualPdeNames::at_other_cell(const Expression& part) {
    const auto found = own_species_.find(part.text.substr(0, part.text.size() - 1));
    if (found == own_species_.end() || part.of.size() != 2) {
        fail(part.span, "a species at two coordinates is expected here");
        return std::nullopt;
    }
    differentiate(found->second);
    Expression value = name(found->second);
    for (std::size_t k = 0; k < 2; ++k) {
        // The argument is the position plus an offset. The offset is found from its values.
        const char axis = k == 0 ? 'x' : 'y';
        const Expression offset =
            replaced(operation(part.of[k], "-", place(axis)),
                     [&](const Expression& inner) -> std::optional<Expression> {
                         if (inner.is_name("domain.x") || inner.is_name("domain.y"))
                             return number(0);
                         if (inner.is_name("domain.width")) return number(width);
                         if (inner.is_name("domain.height")) return number(height);
                         if (inner.is_name("domain.spacing")) return number(spacing);
                         const auto known = values_.find(inner.text);
                         return known == values_.end() ? std::nullopt
                                                       : std::optional(number(known->second));
                     });
        const bool has_place = mentions(part.of[k], axis == 'x' ? "domain.x" : "domain.y");
        const auto distance = value_of(offset);
        const double cells = distance ? *distance / spacing : 0.5;
        if (!has_place || std::abs(cells - std::round(cells)) > 1e-6 || std::abs(cells) > 8) {
            fail(part.span, "only values a whole number of cells away, at most 8, are imported");
            return std::nullopt;
        }
        if (cells != 0) value = shifted(value, axis, static_cast<int>(std::round(cells)));
    }
    return value;
}

/// I_S, I_TR, I_SA(x, y): the lightness or a channel of a picture.
std::optional<Expression> VisualPdeNames::picture(const Expression& part, Where where) {
    std::string word = part.text;
    const bool is_second = word.starts_with("I_T");
    constexpr std::pair<char, std::string_view> channels[] = {
        {'R', ", \"red\""}, {'G', ", \"green\""}, {'B', ", \"blue\""}, {'A', ", \"alpha\""}};
    std::string channel;
    for (const auto& [letter, words] : channels) {
        if (word.size() == 4 && word[3] == letter) channel = words;
    }
    if ((word.size() != 3 && channel.empty()) || part.of.size() == 1 || part.of.size() > 2) {
        fail(part.span, fmt::format("'{}' has no meaning here", word));
        return std::nullopt;
    }
    const bool is_own_cell =
        part.of.empty() || (write_formula(part.of[0]) == write_formula(place('x')) &&
                            write_formula(part.of[1]) == write_formula(place('y')));
    if (!is_own_cell) {
        fail(part.span, "a picture read at another place has no counterpart");
        return std::nullopt;
    }
    const std::string file = fmt::format("{}_{}.png", import_.stem, is_second ? "second" : "first");
    const std::string value = fmt::format("image(\"{}\"{})", file, channel);
    const std::string source =
        plain_line(options_.text(is_second ? "imagePathTwo" : "imagePathOne")).substr(0, 60);
    const std::string remark =
        fmt::format("The picture '{}' of VisualPDE must be saved as {} beside this script.", source,
                    file);
    auto& remarks = draft_.remarks;
    if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) {
        remarks.push_back(remark);
    }
    if (where == Where::mask) return name(value);  // Masks read no parameters.
    if (!pictures_.contains(word)) {
        pictures_[word] = names_.declare(word);
        draft_.parameters.push_back(fmt::format("{}: {}", pictures_[word], value));
    }
    return name(pictures_[word]);
}

}  // namespace cascade::importing
