// Gives nodes of an expression graph C++ operators and functions, so that rules can be written like
// formulas: a * b + sqrt(c).
#pragma once

#include "core/vector3.h"
#include "lang/program/expression_graph.h"

#include <array>
#include <concepts>
#include <optional>

namespace cascade {

/// A node of a graph. The graph must outlive the term. Applying a function to terms adds a node to
/// the graph. The type of this node follows from lang/vocabulary/functions.def.
struct Term {
    ExpressionGraph* graph = nullptr;
    NodeId id{};

    operator NodeId() const { return id; }
    friend bool operator==(Term a, Term b) { return a.id == b.id; }
    ValueType type() const { return (*graph)[id].type; }
    bool is(double value) const { return graph->is_number(id, value); }
    Term number(double value) const { return {graph, graph->number(value)}; }
    friend Term zero_like(Term a) { return a.number(0); }

    template <std::same_as<Term>... Terms>
    static Term call(Function function, Term a, Terms... rest) {
        const std::array types{a.type(), rest.type()...};
        return {a.graph,
                a.graph->call(function, {a.id, rest.id...}, type_of_result(function, types))};
    }
    // For each function of functions.def, defines a C++ function with its name: sqrt(a), if_(c, a,
    // b), grad(e), domain_sum(e).
#define CASCADE_FUNCTION(name, ...)              \
    template <std::same_as<Term>... Terms>       \
    friend Term name(Term a, Terms... rest) {    \
        return call(Function::name, a, rest...); \
    }
#include "lang/vocabulary/functions.def"

    friend Term operator+(Term a, Term b) { return add(a, b); }
    friend Term operator-(Term a, Term b) { return subtract(a, b); }
    friend Term operator*(Term a, Term b) { return multiply(a, b); }
    friend Term operator/(Term a, Term b) { return divide(a, b); }
    friend Term operator-(Term a) { return negate(a); }
    friend Term operator<(Term a, Term b) { return less(a, b); }
    friend Term operator>(Term a, Term b) { return greater(a, b); }
    friend Term square(Term a) { return a * a; }
    /// 1 / a where a is above 0, else 0.
    friend Term inverse(Term a) {
        const Term zero = a.number(0), quotient = a.number(1) / a;
        return if_(less(zero, a), quotient, zero);
    }
};

/// A term whose sums and products are simplified if one of the operands is 0.
struct SparseTerm {
    Term term;

    bool is_zero() const { return term.is(0); }
    static SparseTerm call(Function function, SparseTerm a, SparseTerm b) {
        if (function == Function::negate) return -a;
        const auto known = a.term.graph->without_zeros(function, a.term, b.term);
        return {known ? Term{a.term.graph, *known} : Term::call(function, a.term, b.term)};
    }
    friend SparseTerm zero_like(SparseTerm a) { return {a.term.number(0)}; }
    friend SparseTerm operator+(SparseTerm a, SparseTerm b) { return call(Function::add, a, b); }
    friend SparseTerm operator-(SparseTerm a, SparseTerm b) {
        return call(Function::subtract, a, b);
    }
    friend SparseTerm operator-(SparseTerm a) { return zero_like(a) - a; }
    friend SparseTerm operator*(SparseTerm a, SparseTerm b) {
        return call(Function::multiply, a, b);
    }
    friend SparseTerm sqrt(SparseTerm a) { return a.is_zero() ? a : SparseTerm{sqrt(a.term)}; }
    friend SparseTerm inverse(SparseTerm a) { return {inverse(a.term)}; }
};

/// A vector whose three components are terms.
using TermVector = BasicVector3<Term>;
using SparseVector = BasicVector3<SparseTerm>;

}  // namespace cascade
