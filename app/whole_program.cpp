// The first program contains neither this file nor the parts for which the whole program is needed.
#include "app/whole_program.h"

namespace cascade {

void need_whole_program() {}

}  // namespace cascade
