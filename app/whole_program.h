// Starts the whole program before a command needs parts that the first program lacks
// (cmake/first.cmake).
#pragma once

namespace cascade {

/// Replaces the first program by the whole program, which begins the command anew. Does nothing in
/// the whole program. Call this before the command reads standard input or prints a message.
void need_whole_program();

}  // namespace cascade
