// The data that scripts name in quotes: arrays in `field("a.npy")`, pictures in `image("a.png")`
// and, on models, attributes in `attr("name")`.
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
    /// Returns the weights of a convolution's kernel that were read from the file `name`.
    const KernelFile& kernel(NamedPlane name) const { return *kernels_.at(name); }

    /// Calls `look(name, plane)` for each file that scripts read by the function `function`.
    template <typename Look>
    void each_of(Function function, const Look& look) const {
        for (const auto& [name, plane] : planes_) {
            if (name.function == function) look(name, plane);
        }
    }
    /// Returns a copy with the planes that `make` returns for the present planes. Names and kernels
    /// are the same.
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

/// Returns the names of the files that the mask and the formulas of stages read, and for each
/// picture the channels that are read.
std::map<std::string, std::set<PictureChannel>> input_files_of(const Script& script);

/// Checks whether a model's points have all attributes that attr() reads. For each missing
/// attribute, adds an error at the place in the script that reads it.
Result<void> check_attributes(Script& script, const SurfaceMesh& mesh);

/// Reads every file that the mask or a formula names, relative to the script's folder, and the
/// attributes of a model's points. `model` is null on a grid. Pictures are scaled to the grid. Adds
/// an error at the name in the script if a file is missing or has the wrong type, if its shape
/// differs from the grid's, if the model lacks an attribute, or if a picture is read on a model
/// without texture coordinates.
Result<InputFiles> read_input_files(Script& script, const ModelCells* model);

}  // namespace cascade
