// What to call before a command does what the first program leaves out (cmake/first.cmake).
#pragma once

namespace cascade {

/// Does nothing in the whole program. The first program is replaced by the whole program, which
/// begins the command anew. So call this before the command reads standard input or prints a
/// message.
void need_whole_program();

}  // namespace cascade
