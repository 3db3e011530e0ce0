#include "ribvault/verify/verify_printed.hpp"

#include "ribvault/error.hpp"

namespace ribvault {

PrintedVerdict verify_printed(const PrintedLayer&, const PrintedLayer&, const Rational&, const PrintedOptions&) {
    throw Error(ErrorKind::usage, "verify_printed is not built yet");
}

}  // namespace ribvault
