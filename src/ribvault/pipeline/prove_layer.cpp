#include "ribvault/pipeline/prove_layer.hpp"

#include "ribvault/slice/nest_contours.hpp"
#include "ribvault/verify/verify_layer.hpp"

namespace ribvault {
namespace {

const ExactPolygons no_object;
const Region no_cavity;

LayerGeometry geometry(const LayerMaterial& layer) {
    return {layer.slice->exact.get(), &layer.cavity->region, *layer.tracks};
}

/// What lies under a gap: the slice of the layer just below what hangs, whole, for what hangs over its cavity is
/// another matter; of all others the shells alone.
ExactPolygons under_gap(const LayerMaterial& next, const std::vector<const LayerMaterial*>& others) {
    std::vector<ExactContour> contours;
    const auto add_slice = [&](const Slice& slice) {
        for_each_boundary(*slice.exact, [&](const ExactPolygon& boundary) {
            contours.emplace_back(boundary.vertices_begin(), boundary.vertices_end());
        });
    };
    add_slice(*next.slice);
    for (const LayerMaterial* layer : others) {
        add_slice(*layer->slice);
        // The other way round: one less inside, where the slice has one.
        for (const Contour& contour : layer->cavity->region) {
            contours.emplace_back();
            for (auto p = contour.rbegin(); p != contour.rend(); ++p) contours.back().push_back(exact_mm(*p));
        }
    }
    return regularise(contours);
}

}  // namespace

void add_verdict(const LayerVerdict& more, LayerVerdict& verdict) {
    verdict.supported = verdict.supported && more.supported;
    if (verdict.malformed.empty()) verdict.malformed = more.malformed;
    if (!verdict.internal) verdict.internal = more.internal;
    if (!verdict.external) verdict.external = more.external;
    verdict.stages += more.stages;
}

void add_verdict(const PrintVerdict& more, PrintVerdict& verdict) {
    if (verdict.supported && !more.supported) verdict.place = more.place;
    verdict.supported = verdict.supported && more.supported;
    verdict.unsupported_mm += more.unsupported_mm;
    verdict.external_mm += more.external_mm;
    verdict.external_hangs = verdict.external_hangs || more.external_hangs;
    verdict.stages += more.stages;
}

LayerVerdict prove_layer(const LayerMaterial& layer, const LayerMaterial& below, const Settings& settings) {
    const LayerGeometry upper = geometry(layer), lower = geometry(below);
    LayerVerdict verdict = settings.support_gap_layers == 0
                               ? verify_layer(layer.layer, upper, lower, settings)
                               : verify_layer(layer.layer, {&no_object, &no_cavity, *layer.tracks}, lower, settings);
    if (settings.bed_only && !layer.external->empty())
        add_verdict(verify_layer(layer.layer, {&no_object, &no_cavity, *layer.external},
                                 {&no_object, &no_cavity, *below.external}, settings),
                    verdict);
    return verdict;
}

LayerVerdict prove_over_gap(const OverGap& over, const LayerMaterial& holding, const Settings& settings) {
    const LayerGeometry shell{over.upper.slice->exact.get(), &over.upper.cavity->region, {}};
    // Over the cavity of the layer just below, which is the supports' own where there is no gap.
    const LayerMaterial& next = over.gap.empty() ? holding : over.gap.front();
    Settings inside = settings;
    inside.support = Support::internal;
    LayerVerdict verdict =
        verify_layer(over.upper.layer, shell, {next.slice->exact.get(), &next.cavity->region, *next.internal}, inside);
    verdict.external.reset();
    if (over.over_bed) return verdict;
    std::vector<const LayerMaterial*> others{&holding};
    for (std::size_t k = 1; k < over.gap.size(); ++k) others.push_back(&over.gap[k]);
    const ExactPolygons object = under_gap(next, others);
    add_verdict(verify_layer(over.upper.layer, shell, {&object, &no_cavity, *holding.external}, settings), verdict);
    return verdict;
}

}  // namespace ribvault
