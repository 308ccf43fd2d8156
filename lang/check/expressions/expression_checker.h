// Checks one expression, node by node (internal to the checker). The functions are in several
// files:
//
// - check_expression.cpp: the walk over the nodes, names and strings;
// - check_call.cpp: arguments, types and constants of calls;
// - check_context.cpp: whether a call is allowed where it is written;
// - check_operators.cpp: operators of derivatives, vectors and tensors;
// - check_links.cpp: sums over neighbours, and what crawling cells read from neighbours;
// - check_directions.cpp: directions of a model as arguments of `along`;
// - check_convolution.cpp: the kernels of convolutions;
// - check_units.cpp: numbers with a unit.
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/expressions/expand.h"
#include "lang/check/expressions/user_functions.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// Facts about a node that the node itself does not contain.
struct Part {
    /// Whether an error in the node has been reported. Nodes that read this node then cause no
    /// further messages.
    bool has_error = false;
    bool constant = false;
    double value = 0;
    /// Whether the part is a vector multiplied by a tensor, or computed from such a vector.
    bool turned = false;
};

class ExpressionChecker {
public:
    ExpressionChecker(Workspace& work, const ast::Script& script, ast::Expression expression,
                      const Scope& scope)
        : work_(work), script_(script), expression_(expression), scope_(scope) {}
    /// Checks an expanded expression. `from` is the script in which the expression was written.
    ExpressionChecker(Workspace& work, const ast::Script& from, const Expanded& expanded,
                      const Scope& scope)
        : work_(work),
          script_(expanded.parts),
          expression_{0, static_cast<ast::ExprId>(expanded.parts.expressions.size() - 1)},
          scope_(scope),
          from_(from),
          expanded_(&expanded) {}

    std::optional<CheckedExpression> run();

private:
    const ast::Expr& expr(NodeId part) const {
        return script_.expressions[expression_.first + part.index()];
    }
    NodeId part_of(ast::ExprId id) const { return NodeId(id - expression_.first); }
    void error(Span span, std::string message, std::string hint = "") {
        report(work_, span, std::move(message), std::move(hint));
        parts_.back().has_error = true;
    }

    /// Whether the expression belongs to a system of crawling cells. In such a system, a vector
    /// consists of three numbers.
    bool in_cells() const { return is_of_cells(work_, scope_); }

    bool put_definitions_in(Formula& formula);
    void find_places_of_words();
    void take_direction(std::string_view word, std::span<const ast::ExprId> arguments);
    void visit(const ast::Number& number);
    void visit(const ast::Text& text);
    void visit(const ast::Name& name);
    void visit(const ast::Bracketed& bracketed);
    void visit(const ast::Qualified& qualified);
    void visit(const ast::RateOf& rate);
    void visit(const ast::Unary& unary);
    void visit(const ast::Binary& binary);
    void visit(const ast::Call& call);
    void visit(const ast::Over& over);
    void visit(const ast::Indexed& indexed);
    void visit(const ast::Component& component);
    void visit(const ast::Garbage&) { parts_.back().has_error = true; }

    void take(std::optional<Node> node, Span name);
    void apply(Function function, const Operands& operands, std::size_t count);
    void take_unit(const ast::Call& call);
    void take_surface_value(Function function, const ast::Call& call);
    void take_convolution(const ast::Call& call);
    void take_file_value(Function function, const ast::Call& call);
    void take_painted_direction(NodeId image);
    bool is_place_in_file(NodeId root);
    bool take_lag(std::string_view name);
    bool is_kernel(NodeId root, bool reads_lags);
    std::string hint_of_number(const ast::Call& call) const;
    void unknown_function(const ast::Call& call);
    void wrong_count(Function function, std::size_t count);
    bool belongs_here(Function function, Span span);
    void check_types(const Node& node);
    void check_choice(Node& node, NodeId a, NodeId b);
    void check_palette(const Node& node);
    void check_rgb(const Node& node);
    void check_angle(const Node& node);
    void warn(Span span, std::string message, std::string hint);
    void check_lattice(Node& node);
    void check_places();
    void warn_of_place(Span span, std::string_view place);
    void check_shape_in_domain(const Node& node);
    bool check_vectors(const Node& node);
    void check_geometry(Node& node);
    void check_link(Node& node);
    bool has_places(NodeId root);
    void need_vector(NodeId part);
    void check_operator(const Node& node);
    void check_shift(const Node& node);
    void refuse_product(Function function, Span span, ValueType left, ValueType right);
    void check_carrying(const Node& node);
    void check_curl(const Node& node);
    bool is_turned(DefinitionId definition) const;
    bool is_same_everywhere(NodeId part);
    void need(NodeId part, ValueType type);
    void fold_constants(const Node& node);
    /// Whether the part that is being checked belongs to the kernel of a convolution.
    bool stands_in_kernel() const { return in_kernel_[NodeId(parts_.size() - 1)]; }

    Workspace& work_;
    const ast::Script& script_;
    ast::Expression expression_;
    const Scope& scope_;
    const ast::Script& from_ = script_;  ///< The script whose functions the expression can call.
    const Expanded* expanded_ = nullptr;
    Formula formula_;
    IdVector<NodeId, Part> parts_;
    IdVector<NodeId, bool> wants_text_, is_direction_;
    /// For each node, whether it belongs to the kernel of a convolution.
    IdVector<NodeId, bool> in_kernel_;
    /// Whether some nodes of the expression do not belong to the formula, because they are stored
    /// elsewhere.
    bool has_loose_nodes_ = false;
};

/// For each node of the expression, whether it belongs to the kernel of a convolution.
IdVector<NodeId, bool> kernel_parts(const ast::Script& script, ast::Expression expression);

}  // namespace cascade::checking
