// Writes the operands of passes as C expressions, and adds new operands to the tables of the stage.
#pragma once

#include "lang/lower/step_plan.h"
#include "run/emit_c/c_stage.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

class CTables {
public:
    /// Adds the species and the kinds of their sides to the tables. Both arguments must outlive
    /// this object.
    CTables(const CStageRequest& request, CStage& stage);

    /// number() and plane() return C expressions, such as `s->numbers[3]`.
    std::string number(StageItem item);
    std::string plane(const PlaneSource& source);  ///< For a register, the plane of its old values.
    std::string mask(StageItem item);
    std::string temporary(std::size_t number);
    /// Returns the name of a kernel's function. Equal kernels have the same function.
    std::string kernel(const CellKernel& kernel);

    /// Returns the row of an item in the table of numbers.
    std::size_t number_place(StageItem item);
    /// The items in the table of masks.
    const std::vector<StageItem>& masks() const { return masks_; }

    std::string item_path(StageItem item) const;

private:
    std::string item_name(StageItem item) const;
    bool is_late(ItemId item) const;
    void add_plane(const PlaneSource& source);
    std::string add_data(const Field& field);

    const CStageRequest& request_;
    const Program& program_;
    const System& system_;
    CStage& stage_;
    /// Uniform items whose values depend on values in cells. The compiled program computes them.
    std::vector<ItemId> late_;
    // The items and sources in the tables, in the order of the rows.
    std::vector<StageItem> numbers_, masks_;
    std::vector<PlaneSource> planes_;
};

}  // namespace cascade
