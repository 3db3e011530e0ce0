#include "ribvault/pipeline/finish_layer.hpp"

#include <algorithm>
#include <utility>

#include "ribvault/pipeline/prove_layer.hpp"
#include "ribvault/print/order_paths.hpp"
#include "ribvault/print/skirt.hpp"
#include "ribvault/report/layer_shapes.hpp"
#include "ribvault/report/layer_svg.hpp"
#include "ribvault/report/write_mesh.hpp"
#include "ribvault/vault/wall_stability.hpp"
#include "ribvault/verify/gap_check.hpp"

namespace ribvault {

LayerOutput LayerFinisher::finish(const SweptLayer& swept, const LayerMaterial* below) {
    LayerOutput output;
    proof_.measure([&] { prove(swept, below, output); });
    const LayerPaths paths = paths_.measure([&] { return lay_paths(swept, output); });
    describe(swept, paths, output);
    drawing_.measure([&] { draw(swept, below, output); });
    return output;
}

void LayerFinisher::prove(const SweptLayer& swept, const LayerMaterial* below, LayerOutput& output) const {
    const Settings& s = job_.settings;
    const LayerMaterial& layer = swept.material;
    LayerReport& r = output.report;
    r.verdict.layer = layer.layer;
    r.verdict.supported = true;  // layer 0 lies on the bed
    if (below) r.verdict = prove_layer(layer, *below, s);
    if (s.stands_off()) check_gap(swept, r);
    PrintVerdict print_over_gap;
    for (const PrintPart& part : swept.held.parts)
        add_verdict(part.judgement.verdict(), part.over_gap ? print_over_gap : output.print_above);
    for (const OverGap& over : swept.over_gap)
        output.over_gap.push_back(
            {over.upper.layer, prove_over_gap(over, layer, s), over.over_bed ? PrintVerdict() : print_over_gap});
}

// What is extruded outside keeps g off the object on this layer and on those of the gap above it, or the layer is
// not proved. Where it does not keep g off patches of the object, the report says so.
void LayerFinisher::check_gap(const SweptLayer& layer, LayerReport& report) const {
    const Settings& s = job_.settings;
    const std::vector<Segment> outside = segments_of(layer.held.plan, TrackKind::external_support);
    std::optional<Segment> near = find_too_near(*layer.material.slice->exact, outside, s.standoff());
    for (const auto& above : layer.material.slices_above)
        if (!near) near = find_too_near(*above->exact, outside, s.standoff());
    report.patch_in_gap =
        s.support_gap > 0 && std::any_of(layer.patches.begin(), layer.patches.end(), [&](const auto& patches) {
            return find_too_near(*patches, outside, s.support_gap + s.support_width).has_value();
        });
    if (!near) return;
    report.verdict.supported = false;
    report.verdict.malformed = "the external support at (" + std::to_string(to_mm(near->a.x)) + ", " +
                               std::to_string(to_mm(near->a.y)) + ") mm is nearer to the object than " +
                               (s.support_gap > 0 ? "the gap" : "half its width, and would be printed into it");
}

LayerPaths LayerFinisher::lay_paths(const SweptLayer& swept, LayerOutput& output) const {
    const Settings& s = job_.settings;
    const LayerMaterial& layer = swept.material;
    LayerPaths paths = order_paths(swept.held.plan, layer.slice->rounded, job_.tracks.alternate);
    Region air = layer.cavity->region;
    if (layer.outside) air.insert(air.end(), layer.outside->region.begin(), layer.outside->region.end());
    output.map = TravelMap(layer.slice->rounded, air, paths);
    const std::vector<ToolPath> beside =
        layer.layer == 0
            ? skirt_and_brim(layer.slice->rounded, s, job_.tracks, s.outside() ? *layer.tracks : std::vector<Segment>())
            : std::vector<ToolPath>();
    output.text = gcode_layer(paths, output.map, s, job_.printer, beside);
    for (const std::vector<ToolPath>* all : {&beside, &std::as_const(paths.paths)})
        for (const ToolPath& path : *all)
            for (Point p : path.points) output.box.add(p);
    return paths;
}

void LayerFinisher::describe(const SweptLayer& swept, const LayerPaths& paths, LayerOutput& output) const {
    const Settings& s = job_.settings;
    const LayerMaterial& layer = swept.material;
    LayerReport& r = output.report;
    const double height = to_mm(s.height_of(layer.layer));
    const PrintStatistics& p = output.text.statistics;
    r.layer = layer.layer;
    r.z_mm = slicer_.plane_height(layer.layer).get_d();
    r.shell_area_mm2 = area_to_mm2(signed_area(layer.slice->rounded) - signed_area(layer.cavity->region));
    r.shell_volume_mm3 = r.shell_area_mm2 * height;
    for (const Segment& track : *layer.tracks) r.support_length_mm += length(track) / units_per_mm;
    r.support_length_bound_mm = swept.length_bound / units_per_mm;
    const auto of = [](TrackKind kind) { return static_cast<std::size_t>(kind); };
    r.support_printed_length_mm = p.length[of(TrackKind::support)];
    r.support_volume_mm3 = p.volume[of(TrackKind::support)];
    r.external_support_printed_length_mm = p.length[of(TrackKind::external_support)];
    r.external_support_volume_mm3 = p.volume[of(TrackKind::external_support)];
    r.gaps = paths.gaps;
    r.closed_gaps = swept.held.closed_gaps;
    r.bends = paths.bends;
    r.patches = swept.held.patches;
    r.patch_length_mm = to_mm(swept.held.patch_length);
    r.perimeter_length_mm = p.length[of(TrackKind::outer_perimeter)] + p.length[of(TrackKind::inner_perimeter)];
    r.cover_length_mm = p.length[of(TrackKind::cover)];
    r.thin_wall_length_mm = p.length[of(TrackKind::thin_wall)];
    r.thin_places = paths.thin_places;
    r.thin_area_mm2 = area_to_mm2(paths.thin_area);
    r.unfilled_area_mm2 = area_to_mm2(paths.unfilled_area);
    r.filament_mm = p.filament;
    for (double volume : p.volume) r.extruded_mm3 += volume;
    r.trees = static_cast<int>(num_vertices(swept.forest) - num_edges(swept.forest));
    r.wide_trees = wide_trees(swept.forest);
    r.braces = swept.braces;
    const SlenderPlace worst = most_slender(swept.forest, s);
    r.slenderness = worst.ratio, r.slender_at = {to_mm(worst.at.x), to_mm(worst.at.y)};
    r.slender_standing_mm = worst.standing / units_per_mm, r.slender_to_root_mm = worst.to_root / units_per_mm;
    r.closings = layer.closings;
    r.slivers_removed = layer.slice->slivers_removed;
    r.empty = paths.paths.empty();
}

void LayerFinisher::draw(const SweptLayer& swept, const LayerMaterial* below, LayerOutput& output) const {
    const Settings& s = job_.settings;
    const LayerMaterial& layer = swept.material;
    if (job_.svg) {
        output.picture.emplace(pictures_->picture(layer.layer));
        const bool overhangs = output.report.verdict.external && !s.outside();
        output.picture->write(layer_svg(*layer.slice, layer.cavity->region, swept.forest, swept.unsupported, s,
                                        overhangs ? below->slice.get() : nullptr));
        output.picture->finish();
    }
    if (job_.mesh) {
        const Unit top = s.top_of(layer.layer);
        append_walls(swept.forest, top - s.height_of(layer.layer), top, s, output.walls);
    }
    if (job_.layers || job_.html) {
        const LayerShapes shapes =
            shapes_of(*layer.slice, layer.cavity->region, swept.forest, swept.unsupported, swept.held.patch_tracks);
        if (job_.layers) output.shapes = shapes_json(shapes);
        if (job_.html) output.packed = packed_shapes(shapes);
    }
}

}  // namespace ribvault
