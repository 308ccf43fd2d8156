// One pass: the parts that it needs, where it needs them, and their instructions (internal to
// lowering).
//
// Going backwards through the parts it is found at which cells, or for vectors at which faces, each
// is needed; going forwards they are computed there, each once.
#pragma once

#include "core/side.h"
#include "lang/lower/lower_formula.h"
#include "lang/lower/part_graph.h"
#include "lang/lower/pass_planner.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade::lowering {

/// Numbers of what parts have become: temporaries of written parts, aggregates of their parts.
struct Storage {
    std::vector<std::uint32_t> temporary;  ///< By part, where it is written.
    std::vector<std::uint32_t> aggregate;  ///< By part, where it is an aggregate.
    std::vector<std::uint32_t>
        step_invariants;  ///< By part, where it is known before the first pass.
};

class PassLowering {
public:
    PassLowering(const PartGraph& graph, const PassPlanner& planner, const Storage& storage,
                 std::uint32_t pass, KernelAssembly& assembly);

    /// Computes what these parts need in the own cell.
    void compute(std::span<const PartId> wanted);
    /// The value in the own cell of a part that was wanted.
    const Value& value(PartId id) const { return at(id, Offset{}); }

private:
    bool is_plane_at(PartId id, Offsets where) const;
    bool is_source(PartId id, Offsets where) const;
    void need(PartId id, std::uint32_t where) { needs_[id] |= where; }
    void need_operands(PartId id, std::uint32_t where);
    void need_of_stencil(const Part& part);
    void need_of_vector(const Part& part, std::uint32_t faces);
    void need_at_faces(PartId operand, std::uint32_t faces);
    void make_room();

    void compute_part(PartId id);
    ValueId source(PartId id);
    Value plain(PartId id, Offset offset);
    Value& slot(PartId id, std::uint32_t where);
    const Value& at(PartId id, Offset offset) const;
    ValueId number_at(PartId id, Offset offset) const { return at(id, offset)[0]; }
    ValueId face(PartId id, Face face) const;

    // Reading around a cell of a domain with a mask (lower_mask.cpp).
    ValueId beside(PartId id, Offset offset);
    ValueId beside(PartId id, Offset from, Offset step);
    ValueId chosen(Offset inside, ValueId value, ValueId otherwise);
    ValueId entry_beside(PartId tensor, std::size_t entry, Offset offset);

    // Operators (lower_operators.cpp).
    ValueId stencil(PartId id);
    ValueId over_links(const Part& part);
    ValueId laplacian(PartId operand);
    ValueId difference(PartId operand, int axis);
    ValueId second_difference(PartId operand, int axis);
    ValueId cross_difference(PartId operand, int first, int second);
    ValueId squared_gradient(PartId operand);
    ValueId advection(const Part& part);
    ValueId anisotropic(const Part& part);
    ValueId scaled(ValueId value, double factor);
    bool can_read_as_plane(PartId id) const;
    std::uint32_t slot_of_plane(PartId id);
    std::uint32_t slot_of_own_plane(PartId id);

    // Vectors (lower_vectors.cpp).
    ValueId vector_at(PartId id, Face face);
    ValueId average(PartId id, Face face);
    ValueId tensor_entry(PartId tensor, std::size_t entry, Face face);
    ValueId gradient(PartId operand, Face face);
    ValueId divergence(const Part& part);
    ValueId through_sides(PartId flux, Face face, ValueId value);
    /// What decides whether a flux passes the sides of the grid.
    struct Crossing {
        bool goes_across = false;  ///< It may be other than 0 where everything is mirrored.
        bool has_species = false;
        std::array<bool, side_count> is_open{};  ///< A species in it is not mirrored there.
    };
    void find_what_crosses_sides();

    const PartGraph& graph_;
    const PassPlanner& planner_;
    const Storage& storage_;
    std::uint32_t pass_;
    KernelAssembly& assembly_;
    KernelBuilder& builder_;
    const Grid& grid_;
    std::vector<std::uint32_t> needs_;  ///< By part: where it is needed.
    std::vector<std::uint32_t> first_;  ///< By part: its first value.
    std::vector<Value> values_;
    std::vector<Crossing> crossings_;  ///< By part; empty until it is asked.
};

/// Which entry (0: a11, 1: a12, 2: a22) of a tensor lies in a row and column; −1 where it is 0.
int entry_of_tensor(int row, int column);

}  // namespace cascade::lowering
