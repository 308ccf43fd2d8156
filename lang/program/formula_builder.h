// Makes formulas: equal parts are one part, numbers are computed, and what nothing is added to or
// multiplied by is left out. For formulas about formulas (derivatives): values that reach a user's
// pattern are computed by formulas as they were written.
#pragma once

#include "lang/program/program.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <tuple>
#include <vector>

namespace cascade {

/// Position of a part in the builder's list.
using PartId = std::uint32_t;

class FormulaBuilder {
public:
    PartId number(double value);
    /// A part as it is, its operands being parts of this builder already.
    PartId part(Node node);

    // Sums and products are simplified where a 0, a 1 or two numbers meet. A product with 0 is 0,
    // whatever the other factor.
    PartId add(PartId a, PartId b);
    PartId subtract(PartId a, PartId b);
    PartId multiply(PartId a, PartId b);
    PartId divide(PartId a, PartId b);
    PartId negate(PartId a);
    PartId absolute(PartId a);
    PartId power(PartId a, PartId b);
    PartId maximum(PartId a, PartId b);
    PartId call(Function function, std::initializer_list<PartId> operands);
    PartId choose(PartId condition, PartId then, PartId otherwise);

    const Node& operator[](PartId id) const { return nodes_[id]; }
    std::size_t size() const { return nodes_.size(); }
    bool is_number(PartId id, double value) const {
        return nodes_[id].kind == NodeKind::number && nodes_[id].number == value;
    }
    bool is_number(PartId id) const { return nodes_[id].kind == NodeKind::number; }

    /// The formula whose whole is `root`: its parts and what they read.
    Formula formula(PartId root) const;

private:
    using Key = std::tuple<NodeKind, Function, ValueType, std::uint64_t, std::uint32_t,
                           std::uint32_t, std::uint8_t, Operands>;

    std::vector<Node> nodes_;
    std::map<Key, PartId> known_;
};

}  // namespace cascade
