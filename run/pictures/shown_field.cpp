// Converts and cuts fields before they are painted.
#include "run/pictures/shown_field.h"

#include <utility>

namespace cascade {

Field shown(Field field, const PictureRequest& request) {
    if (field.precision() != Precision::single) field = field.converted(Precision::single);
    return field.layout().depth > 1 ? cut(field, request.slice) : std::move(field);
}

Field as_shown(const Field& field, const DomainMask* mask, const PictureRequest& request) {
    return shown(mask ? with_outside(field, *mask, nothing_outside) : field.clone(), request);
}

}  // namespace cascade
