// Ctrl-C and SIGTERM: noted once, acted on between layers; nothing is left under the final names.
#pragma once

namespace ribvault::cli {

void catch_interrupts();
bool interrupted() noexcept;

}  // namespace ribvault::cli
