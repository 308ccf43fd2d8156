// Checks functions that read data named by a text: a file, or an attribute of a model's points.
// Their other arguments, a channel and a position in the file, are known before the run. So these
// arguments are stored in the literals of the program and not in the formula. The call contains
// their index.
#include "lang/check/expressions/expression_checker.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cascade::checking {

namespace {

/// Whether the node depends on the cell's position and is known before the run.
bool is_of_place(const Node& node) {
    const auto* const builtin = node.as<Builtin>();
    return builtin != nullptr && *builtin != Builtin::t && *builtin != Builtin::step &&
           *builtin < Builtin::curvature;
}

}  // namespace

/// Whether the formula of a position can be computed before the run, either for each cell or, in a
/// kernel, for each lag. Reports an error if not.
bool ExpressionChecker::is_place_in_file(NodeId root) {
    need(root, ValueType::number);
    if (parts_.back().has_error) return false;
    const bool in_kernel = stands_in_kernel();
    const auto is_of_lag = [](const Node& node) {
        return node.is(CellValue::distance) || node.is(CellValue::direction) ||
               node.calls(Function::component);
    };
    for (const Node& node : formula_of(formula_.nodes, root).nodes) {
        const bool is_elementary_call = node.is<Call>() && is_elementary(node.function);
        if (node.is<double>() || is_elementary_call) continue;
        if (in_kernel ? is_of_lag(node) : is_of_place(node)) continue;
        error(node.span, "this value cannot be used to give a position in a file",
              in_kernel
                  ? "in a kernel, a position can contain only numbers, distance and direction"
                  : "a position can contain only numbers, x, y, z, sx, sy, sz, nx, ny and nz");
        return false;
    }
    return true;
}

/// Checks attr("name"), field("a.npy") and image("f.png"). A position may follow: two or three
/// numbers for a field, two for an image. For an image, a channel may be given, too. In the node,
/// only the text remains.
void ExpressionChecker::take_file_value(Function function, const ast::Call& call) {
    std::vector<NodeId> parts;
    for (std::uint32_t k = 0; k < call.argument_count; ++k) {
        parts.push_back(part_of(script_.arguments[call.first_argument + k]));
        if (parts_[parts.back()].has_error) parts_.back().has_error = true;
    }
    if (parts_.back().has_error) return;
    need(parts[0], ValueType::text);
    if (parts_.back().has_error) return;
    FileReading reading;
    std::size_t at = 1;
    if (function == Function::image && parts.size() % 2 == 0) {
        need(parts[at], ValueType::text);
        if (parts_.back().has_error) return;
        const Node& word = formula_.nodes[parts[at++]];
        const std::string& name = work_.program.literals->text(std::get<TextId>(word.kind));
        const auto channel = picture_channel_named(name);
        if (!channel) {
            return error(word.span, fmt::format("a picture has no channel '{}'", name),
                         fmt::format("it has {}", fmt::join(picture_channel_names, ", ")));
        }
        reading.channel = *channel;
    }
    if (function == Function::field && parts.size() == 2) return wrong_count(function, 2);
    for (; at < parts.size(); ++at) {
        if (!is_place_in_file(parts[at])) return;
        reading.place.push_back(formula_of(formula_.nodes, parts[at]));
    }
    Node& node = formula_.nodes.back();
    if (stands_in_kernel() && reading.place.empty()) {
        return error(node.span, "in a kernel, field and image need a position in the file",
                     "write field(\"k.npy\", distance / 10, 0.5), for example");
    }
    has_loose_nodes_ = has_loose_nodes_ || parts.size() > 1;
    node.kind = Call{work_.program.literals->add(std::move(reading))};
    node.function = function;
    node.operands = {parts[0]};
    node.operand_count = 1;
}

/// Checks along(image("f.png")). The red channel of the image is the direction's component to the
/// right, and the green channel is its upward component.
void ExpressionChecker::take_painted_direction(NodeId image) {
    const Node& painted = formula_.nodes[image];
    FileReading reading = work_.program.literals->reading(painted.as<Call>()->detail);
    if (reading.channel != PictureChannel::lightness) {
        return error(painted.span, "a direction needs two channels of a picture, not one",
                     "write along(image(\"f.png\")), which reads the channels red and green");
    }
    reading.is_direction = true;
    Node& node = formula_.nodes.back();
    node.kind = Call{work_.program.literals->add(std::move(reading))};
    node.function = Function::image;
    node.operands = {painted.operands[0]};
    node.operand_count = 1;
    has_loose_nodes_ = true;
}

}  // namespace cascade::checking
