// CGAL's CORE numbers without their diagnostics file.
//
// CORE writes warnings of its floating-point filter ("possible zero divisor!": the filter cannot exclude it, exact
// arithmetic then decides) into a file Core_Diagnostics in the user's current folder, and ends the program on errors.
// Here warnings are dropped and errors are exceptions.
#pragma once

#include <CGAL/CORE/CoreAux.h>

#include <stdexcept>
#include <string>

namespace CORE {
inline void report_to_ribvault(const std::string& message, bool error) {
    if (error) throw std::logic_error("exact arithmetic (CORE): " + message);
}
}  // namespace CORE

#define core_error(message, file, line, error) report_to_ribvault(message, error)
#include <CGAL/CORE_Expr.h>
#undef core_error
