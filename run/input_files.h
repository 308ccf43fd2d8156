// Files that a script reads: the arrays of `field("a.npy")` and the pictures of `image("a.png")`.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "run/script.h"

#include <cstdint>
#include <map>

namespace cascade {

/// Planes by the number of their path in Program::texts.
class InputFiles {
public:
    void add(std::uint32_t text, Field plane) { planes_[text] = std::move(plane); }
    void add_image(std::uint32_t text, Field plane) { images_[text] = std::move(plane); }
    const Field& plane(std::uint32_t text) const { return planes_.at(text); }
    const Field& image(std::uint32_t text) const { return images_.at(text); }

    /// The same files, a plane made of each.
    template <typename Make>
    InputFiles mapped(const Make& make) const {
        InputFiles result;
        for (const auto& [text, plane] : planes_) result.add(text, make(plane));
        for (const auto& [text, plane] : images_) result.add_image(text, make(plane));
        return result;
    }

private:
    std::map<std::uint32_t, Field> planes_;
    std::map<std::uint32_t, Field> images_;
};

/// Reads every file that the mask or a starting value names, relative to the script's folder. A missing file,
/// a wrong type or a shape other than the grid's is a diagnostic at the path in the script. Pictures
/// are fitted to the grid.
Result<InputFiles> read_input_files(Script& script);

}  // namespace cascade
