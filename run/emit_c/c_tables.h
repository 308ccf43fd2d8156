// The operands of passes as C expressions. New ones are added to the tables of the stage.
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
    /// Adds the species and kinds of sides. Both arguments must outlive the tables.
    CTables(const CStageRequest& request, CStage& stage);

    /// Each returns a C expression, such as `s->numbers[3]`.
    std::string number(StageItem item);
    std::string plane(const PlaneSource& source);  ///< Of registers only the old values.
    std::string mask(StageItem item);
    std::string temporary(std::size_t number);
    /// The name of a kernel's function; equal kernels share one.
    std::string kernel(const CellKernel& kernel);

    /// The index of an item in the table of numbers.
    std::size_t number_place(StageItem item);
    /// The items of the table of masks.
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
    /// Uniform items whose values are known only once there are cells.
    std::vector<ItemId> late_;
    // In the order of the tables.
    std::vector<StageItem> numbers_, masks_;
    std::vector<PlaneSource> planes_;
};

}  // namespace cascade
