// The files named in quotes in a script: arrays of `field("a.npy")`, pictures of `image("a.png")`
// and, on models, `attr("name")`.
#pragma once

#include "core/picture_channel.h"
#include "core/plane.h"
#include "core/result.h"
#include "lang/lower/slot_source.h"
#include "run/domain/kernel_file.h"
#include "run/domain/model_cells.h"
#include "run/script/script.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace cascade {

class InputFiles {
public:
    void add(NamedPlane name, Field plane) { planes_[name] = std::move(plane); }
    const Field& plane(NamedPlane name) const { return planes_.at(name); }

    void add_kernel(NamedPlane name, KernelFile file) {
        kernels_[name] = std::make_shared<const KernelFile>(std::move(file));
    }
    /// The data of a convolution's kernel.
    const KernelFile& kernel(NamedPlane name) const { return *kernels_.at(name); }

    /// Calls `look` with the name and the plane of each file read by this function.
    template <typename Look>
    void each_of(Function function, const Look& look) const {
        for (const auto& [name, plane] : planes_) {
            if (name.function == function) look(name, plane);
        }
    }
    /// The same files, with a new plane made from each, and the same kernels.
    template <typename Make>
    InputFiles mapped(const Make& make) const {
        InputFiles result;
        result.kernels_ = kernels_;
        for (const auto& [name, plane] : planes_) result.add(name, make(plane));
        return result;
    }

private:
    std::map<NamedPlane, Field> planes_;
    std::map<NamedPlane, std::shared_ptr<const KernelFile>> kernels_;
};

/// The names of the files read by the mask and the formulas of stages, with the channels of
/// pictures.
std::map<std::string, std::set<PictureChannel>> input_files_of(const Script& script);

/// Checks that a model's points have everything read by attr(). If not, reports diagnostics at the
/// text in the script.
Result<void> check_attributes(Script& script, const SurfaceMesh& mesh);

/// Reads every file named in the mask or a formula, relative to the script's folder, and the values
/// of a model's points (null on a grid). A missing file, a wrong type, a shape other than the
/// grid's, a name unknown to the model and a picture on a model without texture coordinates give
/// diagnostics at the text in the script. Pictures are scaled to the grid.
Result<InputFiles> read_input_files(Script& script, const ModelCells* model);

}  // namespace cascade
