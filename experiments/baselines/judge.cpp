#include "judge.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "ribvault/slice/exact_polygons.hpp"

namespace ribvault::baselines {

Judgement judge(const Stack& stack, const Hollowed& hollowed, const Settings& settings) {
    const int layers = static_cast<int>(stack.slices.size());
    std::vector<LayerVerdict> verdicts(stack.slices.size());
    const auto geometry = [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        return LayerGeometry{stack.slices[k].exact.get(), &hollowed.cavities[k], hollowed.tracks[k]};
    };
    oneapi::tbb::parallel_for(1, layers, [&](int i) {
        verdicts[static_cast<std::size_t>(i)] = verify_layer(i, geometry(i), geometry(i - 1), settings);
    });
    Judgement sum;
    sum.layers = layers;
    for (int i = 1; i < layers; ++i) {
        const LayerVerdict& v = verdicts[static_cast<std::size_t>(i)];
        sum.refuted += !v.supported;
        sum.malformed += !v.malformed.empty();
        sum.external += v.external.has_value();
        sum.stages += v.stages;
        if (!v.internal) continue;
        sum.area_lo_mm2 += v.internal->area_lo;
        sum.area_hi_mm2 += v.internal->area_hi;
        sum.worst_distance_mm = std::max(sum.worst_distance_mm, v.internal->witness_distance);
    }
    return sum;
}

double material_mm3(const Stack& stack, const Hollowed& hollowed, const Settings& settings) {
    double empty = 0;
    for (std::size_t i = 0; i < hollowed.cavities.size(); ++i)
        empty += to_mm(settings.height_of(i)) * area_to_mm2(signed_area(hollowed.cavities[i]));
    return stack.volume_mm3 - empty + hollowed.track_volume_mm3;
}

}  // namespace ribvault::baselines
