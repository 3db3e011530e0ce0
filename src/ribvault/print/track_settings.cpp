#include "ribvault/print/track_settings.hpp"

#include "ribvault/print/check_range.hpp"

namespace ribvault {

void TrackSettings::check(Unit nozzle) const {
    if (first_layer_width != 0)
        check_range("--first-layer-width (mm)", to_mm(first_layer_width), to_mm(nozzle), 2 * to_mm(nozzle));
    check_range("--resolution (mm)", to_mm(resolution), 0, to_mm(nozzle) / 4);
    check_range("--skirt (loops)", skirt_loops, 0, 100);
    check_range("--skirt-distance (mm)", to_mm(skirt_distance), 0, 1000);
    check_range("--brim (mm)", to_mm(brim_width), 0, 1000);
}

}  // namespace ribvault
