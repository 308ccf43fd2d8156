// Builds the fields of a request for a picture, so that the engine draws what the page shows.
import { is_held } from "./look";
import type { Pattern } from "./pattern";

const side = 960;          ///< The approximate longest side of a picture of cells, in pixels.
const most_enlarged = 64;

/// The fields of the message `picture`, except `show` and `palette`.
export function picture_fields(pattern: Pattern): Record<string, unknown> {
    const { snapshot, look, solid, columns, rows } = pattern, fields: Record<string, unknown> = { scale: 1 };
    if (!snapshot) return fields;
    const { surface, is_model, slice } = snapshot, { low, high } = pattern.range_of(snapshot);
    if (pattern.is_solid) Object.assign(fields, solid.view);
    else fields.scale = Math.min(most_enlarged, Math.max(1, Math.floor(side / Math.max(columns, rows))));
    if (!pattern.is_solid && surface > 0 && !is_model) fields.flat = true;
    // If all values are the same, the engine chooses the range as in other pictures.
    if (is_held(look) && low !== high) Object.assign(fields, { low, high });
    if (slice) Object.assign(fields, { axis: slice.axis, place: (slice.number + 0.5) / slice.sides["xyz".indexOf(slice.axis)] });
    return fields;
}
