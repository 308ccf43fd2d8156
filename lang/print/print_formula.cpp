// Prints formulas without recursion. A stack contains the nodes and strings that still have to be
// written.
#include "lang/print/print_formula.h"

#include "core/overloaded.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <variant>

namespace cascade {

namespace {

/// A node that is written as an operand. It gets brackets if its precedence is below the needed
/// precedence.
struct Part {
    NodeId node;
    int least = 0;
};

using Item = std::variant<Part, std::string_view>;

constexpr std::size_t most_repeated = 10'000;

class Printer {
public:
    Printer(const Program& program, const System& system, const Formula& formula,
            std::optional<std::uint32_t> stage)
        : program_(program), system_(system), formula_(formula), stage_(stage) {}

    std::string run() {
        push(Part{NodeId(formula_.nodes.size() - 1), 0});
        while (!stack_.empty()) {
            const Item item = stack_.back();
            stack_.pop_back();
            if (const auto* mark = std::get_if<std::string_view>(&item)) text_ += *mark;
            else write(std::get<Part>(item));
        }
        return std::move(text_);
    }

private:
    void push(Item item) { stack_.push_back(item); }

    void write(const Part& part) {
        // If several nodes read a node, such as the argument of a function, it is written for each
        // of them. The total number of written nodes is limited.
        if (++written_ > formula_.nodes.size() + most_repeated) {
            text_ += "…";
            return;
        }
        const Node& node = formula_.nodes[part.node];
        if (!node.is<Call>()) {
            text_ += leaf(node);
        } else if (info(node.function).is_operator) {
            write_operator(node, part.least);
        } else {
            write_call(node);
        }
    }

    void write_operator(const Node& node, int least) {
        const int own = info(node.function).precedence;
        const bool brackets = own < least;
        if (brackets) text_ += "(";
        if (brackets) push(std::string_view(")"));
        const std::string_view spelling = info(node.function).spelling;
        if (node.operand_count == 1) {
            text_ += spelling;
            if (node.function == Function::logical_not) text_ += " ";
            push(Part{node.operands[0], own});
            return;
        }
        // Comparisons need brackets on both sides, because they do not chain.
        const bool chains = own != 4;
        const bool to_the_right = node.function == Function::power;
        push(Part{node.operands[1], to_the_right ? 7 : own + 1});
        push(std::string_view(" "));
        push(spelling);
        push(std::string_view(" "));
        push(Part{node.operands[0], chains && !to_the_right ? own : own + 1});
    }

    void write_call(const Node& node) {
        if (node.calls(Function::component)) return write_component(node);
        if (reads_file(node.function)) return write_reading(node);
        const std::string_view spelling = info(node.function).spelling;
        if (const std::size_t name = spelling.find(' '); name != std::string_view::npos) {
            text_ += fmt::format("{}(", spelling.substr(0, name));
            push(std::string_view(")"));
            if (node.operand_count == 2) {
                push(std::string_view(")"));
                push(Part{node.operands[1], 0});
                push(std::string_view("("));
            }
            push(spelling.substr(name));
            push(Part{node.operands[0], 0});
            return;
        }
        text_ += spelling;
        text_ += "(";
        push(std::string_view(")"));
        for (std::size_t i = node.operand_count; i > 0; --i) {
            push(Part{node.operands[i - 1], 0});
            if (i > 1) push(std::string_view(", "));
        }
    }

    void write_reading(const Node& node) {
        const FileReading& reading = program_.literals->reading(node.as<Call>()->detail);
        const std::string& name =
            program_.literals->text(std::get<TextId>(formula_.nodes[node.operands[0]].kind));
        if (reading.is_direction) text_ += "along(";
        text_ += fmt::format("{}(\"{}\"", info(node.function).spelling, name);
        if (reading.channel != PictureChannel::lightness) {
            text_ += fmt::format(", \"{}\"", name_of(reading.channel));
        }
        for (const Formula& place : reading.place) {
            text_ += ", " + Printer(program_, system_, place, stage_).run();
        }
        text_ += reading.is_direction ? "))" : ")";
    }

    void write_component(const Node& node) {
        static constexpr std::array<std::string_view, 3> ends{".x", ".y", ".z"};
        const auto* const axis = formula_.nodes[node.operands[1]].as<double>();
        push(ends[static_cast<std::size_t>(axis != nullptr ? *axis : 0)]);
        push(Part{node.operands[0], FunctionInfo::of_a_name});
    }

    std::string of_stage(StageItem each) const {
        return fmt::format("{}.{}", program_.stages[each.stage].name,
                           program_.system_of(each.stage).item_name(each.item));
    }

    std::string leaf(const Node& node) const {
        const auto of = [](const auto& names, auto key) {
            return std::string(names[static_cast<std::size_t>(key)]);
        };
        const Overloaded text{
            [](double number) { return fmt::format("{}", number); },
            [&](TextId id) { return fmt::format("\"{}\"", program_.literals->text(id)); },
            [&](ItemId item) {
                // The position is the only item that is a vector.
                const std::string_view name =
                    node.type == ValueType::vector ? "p" : system_.item_name(item);
                return fmt::format(fmt::runtime(stage_ ? "[{}]" : "{}"), name);
            },
            [&](StageItem each) { return of_stage(each); },
            [&](SensedItem each) { return of_stage(each.item); },
            [&](SurfaceValueId id) { return text_of(program_.literals->surface_value(id)); },
            [&](DefinitionId id) { return system_.definitions[id].name; },
            [&](Rate rate) { return system_.quantities[rate.species].name + "'"; },
            [&](Builtin builtin) { return of(builtin_names, builtin); },
            [&](CellValue value) { return of(cell_value_names, value); },
            [&](MetricPlane plane) { return of(metric_names, plane); },
            [&](ModelPlane plane) { return of(model_names, plane); },
            [](InsideMask) { return std::string("(inside)"); },
            [&](LagPart part) { return of(lag_part_names, part); },
            [&](Unknown unknown) { return program_.literals->constraint(unknown.number).unknown; },
            [](Call) { return std::string(); },
        };
        return std::visit(text, node.kind);
    }

    const Program& program_;
    const System& system_;
    const Formula& formula_;
    std::optional<std::uint32_t> stage_;
    std::vector<Item> stack_;
    std::size_t written_ = 0;
    std::string text_;
};

}  // namespace

std::string text_of(const SurfaceValue& value) {
    if (value.function == Function::along) {
        constexpr std::array words{"axis", "gradient", "curvature_high", "curvature_low", "keys"};
        std::vector<double> numbers = value.numbers;
        if (value.direction != DirectionSettings::Kind::axis) numbers.push_back(value.smoothing);
        return fmt::format("along({}({}))", words[static_cast<std::size_t>(value.direction)],
                           fmt::join(numbers, ", "));
    }
    return fmt::format("{}({})", info(value.function).spelling, fmt::join(value.numbers, ", "));
}

std::string print_formula(const Program& program, const System& system, const Formula& formula,
                          std::optional<std::uint32_t> stage) {
    if (formula.nodes.empty()) return "";
    return Printer(program, system, formula, stage).run();
}

}  // namespace cascade
