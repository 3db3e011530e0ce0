#include "ribvault/print/track_settings.hpp"

#include <cstdio>

#include "ribvault/error.hpp"

namespace ribvault {

void TrackSettings::check(Unit nozzle) const {
    const auto refuse = [](const char* name, double value, double lo, double hi) {
        if (value >= lo && value <= hi) return;
        char text[160];
        std::snprintf(text, sizeof text, "%s is %g; it must lie between %g and %g", name, value, lo, hi);
        throw Error(ErrorKind::usage, text);
    };
    if (first_layer_width != 0)
        refuse("--first-layer-width (mm)", to_mm(first_layer_width), to_mm(nozzle), 2 * to_mm(nozzle));
    refuse("--resolution (mm)", to_mm(resolution), 0, to_mm(nozzle) / 4);
    refuse("--skirt (loops)", skirt_loops, 0, 100);
    refuse("--skirt-distance (mm)", to_mm(skirt_distance), 0, 1000);
    refuse("--brim (mm)", to_mm(brim_width), 0, 1000);
}

}  // namespace ribvault
