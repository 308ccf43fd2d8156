// Planes that somebody keeps while the simulation goes on, such as arrays of an embedding program.
#pragma once

#include "core/plane.h"

#include <memory>

namespace cascade {

/// Counts one more owner of the memory of a plane, which free_plane() frees when it has been called
/// for every owner. `plane` is what allocate_plane() returned.
void add_owner_of_plane(const void* plane);
bool has_several_owners(const void* plane);

/// The memory of a field as allocate_plane() returned it. The field is not empty.
inline const void* memory_of(const Field& field) {
    return field.visit([](const auto& plane) -> const void* {
        return plane.origin() - plane.layout().offset(0, 0);
    });
}

/// Keeps the cells of a field as they are for as long as the result lives. Whoever would change
/// them in place, as steps do, changes a copy instead if is_shared().
inline std::shared_ptr<const void> share(const Field& field) {
    const void* const memory = memory_of(field);
    add_owner_of_plane(memory);
    return {memory, [](const void* kept) { free_plane(const_cast<void*>(kept)); }};
}

inline bool is_shared(const Field& field) {
    return !field.empty() && has_several_owners(memory_of(field));
}

}  // namespace cascade
