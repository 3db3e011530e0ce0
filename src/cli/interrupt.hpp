// Ctrl-C and SIGTERM: noted once, acted on between layers; a second one ends the program at once. Neither leaves
// anything behind.
#pragma once

namespace ribvault::cli {

void catch_interrupts();
bool interrupted() noexcept;

}  // namespace ribvault::cli
