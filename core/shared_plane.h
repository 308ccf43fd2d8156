// Planes with a second owner, such as an array of an embedding program. The second owner keeps the
// plane while the simulation goes on.
#pragma once

#include "core/plane.h"

#include <memory>

namespace cascade {

/// Counts one more owner of a plane's memory. free_plane() must be called once per owner, and the
/// last call frees the memory. `plane` is what allocate_plane() returned.
void add_owner_of_plane(const void* plane);
bool has_several_owners(const void* plane);

/// The address of a field's memory, as returned by allocate_plane(). The field must not be empty.
inline const void* memory_of(const Field& field) {
    return field.visit([](const auto& plane) -> const void* {
        return plane.origin() - plane.layout().offset(0, 0);
    });
}

/// Returns an object that keeps the cells of a field unchanged while it exists. Code that changes
/// cells in place, such as a step, must first call is_shared(). If it returns true, the code must
/// change a copy.
inline std::shared_ptr<const void> share(const Field& field) {
    const void* const memory = memory_of(field);
    add_owner_of_plane(memory);
    return {memory, [](const void* kept) { free_plane(const_cast<void*>(kept)); }};
}

inline bool is_shared(const Field& field) {
    return !field.empty() && has_several_owners(memory_of(field));
}

}  // namespace cascade
