// Integers of 128 bits: not part of ISO C++; g++ and clang have them on every 64-bit platform.
#pragma once

namespace ribvault {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

}  // namespace ribvault
