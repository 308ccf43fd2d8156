// The first program leaves out this file, as it leaves out what the whole program is needed for.
#include "app/whole_program.h"

namespace cascade {

void need_whole_program() {}

}  // namespace cascade
