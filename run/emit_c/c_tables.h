// What passes read and write, as expressions of C. What is met for the first time enters the tables
// of the stage.
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
    /// Enters the species and kinds of sides. Both must live as long as the tables.
    CTables(const CStageRequest& request, CStage& stage);

    /// Each is the text of an expression, such as `s->numbers[3]`.
    std::string number(const SlotSource& source);
    std::string plane(const SlotSource& source);  ///< Of no register of a step but the old values.
    std::string mask(const SlotSource& source);
    std::string temporary(std::size_t number);
    /// The name of a kernel's function; kernels of the same code share one.
    std::string kernel(const CellKernel& kernel);

    /// Contexts in the tables.
    std::size_t number_place(const SlotSource& source);
    /// Sources of the masks in their table.
    const std::vector<SlotSource>& masks() const { return masks_; }

    std::string item_path(std::uint32_t stage, std::uint32_t item) const;

private:
    std::string item_name(const SlotSource& source) const;
    bool is_late(std::uint32_t item) const;
    void add_plane(const SlotSource& source);
    std::string add_data(const Field& field);

    const CStageRequest& request_;
    const Program& program_;
    const System& system_;
    CStage& stage_;
    std::vector<std::uint32_t> species_;  ///< Items.
    /// Items that are the same in all cells, but known only when there are cells.
    std::vector<std::uint32_t> late_;
    std::vector<SlotSource> numbers_, planes_, masks_;  ///< In order of the tables.
};

}  // namespace cascade
