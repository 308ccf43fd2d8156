// Finds the null vectors of a matrix of dimensions, by arithmetic with rational numbers.
#include "lang/check/dimensionless_groups.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace cascade {

namespace {

/// A rational number in lowest terms. The denominator is above 0.
struct Ratio {
    std::int64_t above = 0, below = 1;

    bool is_zero() const { return above == 0; }
};

Ratio ratio(std::int64_t above, std::int64_t below) {
    const std::int64_t sign = below < 0 ? -1 : 1;
    const std::int64_t common = std::max<std::int64_t>(std::gcd(above, below), 1);
    return {sign * above / common, sign * below / common};
}
Ratio operator*(Ratio a, Ratio b) { return ratio(a.above * b.above, a.below * b.below); }
Ratio operator/(Ratio a, Ratio b) { return ratio(a.above * b.below, a.below * b.above); }
Ratio operator-(Ratio a, Ratio b) {
    return ratio(a.above * b.below - b.above * a.below, a.below * b.below);
}

/// A value that can occur in a group.
struct GroupVariable {
    std::string name;
    Dimension dimension;
};

/// The matrix of dimensions: a row for each base quantity, a column for each variable.
class DimensionMatrix {
public:
    explicit DimensionMatrix(const std::vector<GroupVariable>& variables) : variables_(variables) {
        for (auto& row : rows_) row.resize(variables.size());
        for (std::size_t column = 0; column < variables.size(); ++column) {
            for (std::size_t k = 0; k < base_quantity_count; ++k) {
                rows_[k][column] = ratio(variables[column].dimension.sixths[k], 6);
            }
        }
    }

    std::vector<DimensionlessGroup> null_vectors() {
        eliminate();
        std::vector<DimensionlessGroup> groups;
        for (std::size_t column = 0; column < variables_.size(); ++column) {
            if (std::ranges::find(pivots_, column) != pivots_.end()) continue;
            // The smallest power of this variable that makes the powers of all variables integers.
            std::int64_t power = 1;
            for (std::size_t row = 0; row < pivots_.size(); ++row) {
                power = std::lcm(power, rows_[row][column].below);
            }
            DimensionlessGroup group{{variables_[column].name, power}};
            for (std::size_t row = 0; row < pivots_.size(); ++row) {
                const Ratio of_pivot = rows_[row][column] * ratio(-power, 1);
                if (of_pivot.is_zero()) continue;
                group.push_back({variables_[pivots_[row]].name, of_pivot.above});
            }
            groups.push_back(std::move(group));
        }
        return groups;
    }

private:
    /// Brings the rows to reduced echelon form. pivots_[k] is the column of the 1 in row k.
    void eliminate() {
        for (std::size_t column = 0; column < variables_.size(); ++column) {
            const std::size_t rank = pivots_.size();
            std::size_t pivot = rank;
            while (pivot < rows_.size() && rows_[pivot][column].is_zero()) ++pivot;
            if (pivot == rows_.size()) continue;
            std::swap(rows_[rank], rows_[pivot]);
            const Ratio scale = rows_[rank][column];
            for (Ratio& each : rows_[rank]) each = each / scale;
            for (std::size_t row = 0; row < rows_.size(); ++row) {
                const Ratio times = rows_[row][column];
                if (row == rank || times.is_zero()) continue;
                for (std::size_t k = 0; k < variables_.size(); ++k) {
                    rows_[row][k] = rows_[row][k] - times * rows_[rank][k];
                }
            }
            pivots_.push_back(column);
            if (pivots_.size() == rows_.size()) break;
        }
    }

    const std::vector<GroupVariable>& variables_;
    std::array<std::vector<Ratio>, base_quantity_count> rows_;
    std::vector<std::size_t> pivots_;
};

}  // namespace

DimensionlessGroups dimensionless_groups(const ProgramUnits& units, const Program& program,
                                         std::uint32_t stage) {
    DimensionlessGroups found;
    std::vector<GroupVariable> variables;
    const System& system = program.system_of(stage);
    for (const ItemId item : system.quantities.ids()) {
        const Quantity& quantity = system.quantities[item];
        if (quantity.is_species) continue;
        const auto& dimension = units.items[stage][item];
        if (dimension) variables.push_back({quantity.name, *dimension});
        else found.without_unit.push_back(quantity.name);
    }
    if (!found.without_unit.empty() || variables.empty()) return found;
    const bool is_flat = !program.domain.model && !program.domain.surface;
    if (is_flat && units.units.knows(BaseQuantity::length)) {
        variables.push_back({"width", Dimension::of(BaseQuantity::length)});
    }
    if (program.stages[stage].time.duration && units.units.knows(BaseQuantity::time)) {
        variables.push_back({"duration", Dimension::of(BaseQuantity::time)});
    }
    found.groups = DimensionMatrix(variables).null_vectors();
    return found;
}

}  // namespace cascade
