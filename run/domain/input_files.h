// The files that a script names in quotes: arrays of `field("a.npy")`, pictures of `image("a.png")`
// and, on models, `attr("name")` and `uvimage("a.png")`.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "lang/lower/step_plan.h"
#include "run/domain/model_cells.h"
#include "run/script/script.h"

#include <cstdint>
#include <map>
#include <utility>

namespace cascade {

/// Planes by the function that reads them and the number of their text in Literals::texts().
class InputFiles {
public:
    using Kind = SlotSource::Kind;  ///< A kind whose slots are named by a text.

    void add(Kind kind, std::uint32_t text, Field plane) {
        planes_[{kind, text}] = std::move(plane);
    }
    const Field& plane(Kind kind, std::uint32_t text) const { return planes_.at({kind, text}); }

    /// Calls `look` with the text and the plane of each that has this kind.
    template <typename Look>
    void each_of(Kind kind, const Look& look) const {
        for (const auto& [name, plane] : planes_) {
            if (name.first == kind) look(name.second, plane);
        }
    }
    /// The same files, with a new plane made from each.
    template <typename Make>
    InputFiles mapped(const Make& make) const {
        InputFiles result;
        for (const auto& [name, plane] : planes_) result.add(name.first, name.second, make(plane));
        return result;
    }

private:
    std::map<std::pair<Kind, std::uint32_t>, Field> planes_;
};

/// Reads every file that the mask or a starting value names, relative to the script's folder, and
/// the values that starting values take from the points and the texture of a model (null on a
/// grid). A missing file, a wrong type, a shape other than the grid's, and a name that the model
/// does not know give diagnostics at the text in the script. Pictures are scaled to the grid.
Result<InputFiles> read_input_files(Script& script, const ModelCells* model);

}  // namespace cascade
