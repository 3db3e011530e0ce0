#include <algorithm>
#include <cmath>

#include "ribvault/pipeline/generate.hpp"
#include "ribvault/report/number_text.hpp"

namespace ribvault {
namespace {

/// Where a list is that is too long for the summary; `on_page`: the page has it too.
std::string where_listed(const Job& job, bool on_page) {
    if (job.report) return "in the report";
    if (on_page && job.html) return "on the page";
    return on_page ? "with --report FILE or --html FILE" : "with --report FILE";
}

/// Is the layer refuted for its slices, which the proof cannot speak of? It says itself of which layer they are.
bool is_of_slices(const LayerReport& layer) { return layer.verdict.malformed.starts_with("layer "); }

/// What may help when something is not proved.
void append_advice(std::string& text, const RunReport& r) {
    const Settings& s = r.settings;
    text += "  what may help: ";
    if (std::any_of(r.layers.begin(), r.layers.end(), is_of_slices))
        text += "the mesh repaired where parts touch or cross, or moved a little (--rotate); ";
    if (s.support_gap > 0) text += "a smaller --support-gap; ";
    if (s.support_gap_layers > 0) text += "fewer --support-gap-layers; ";
    if (s.bed_only) text += "no --bed-only; ";
    if (s.gaps == Gaps::paper) text += "--gaps proved; ";
    text += "another --seed, thinner layers, or the model turned (docs/printing.md, When something is not proved)\n";
}

std::string layers_text(std::size_t layers) { return many(static_cast<long long>(layers), "layer"); }

/// What is proved, and what of it is said otherwise than "within rho of the layer below".
void append_proved(std::string& text, const RunReport& r) {
    append_formatted(text, "proved    equation (2) holds on all %zu layers, decided exactly%s%s\n", r.layers.size(),
                     r.verdict.print_proved ? ",\n          for the geometry and for what is extruded" : "",
                     !r.verdict.print_proved || r.verdict.layers_over_narrow_places.empty()
                         ? ""
                         : ", but not over places too narrow to print");
    if (r.settings.reach_of_object() > r.settings.support_radius)
        append_formatted(
            text,
            "          across the removal gap: outside, all is within rho of a support or within %.5g mm (g + r) of "
            "the object\n",
            to_mm(r.settings.reach_of_object()));
    if (r.settings.support_gap_layers > 0)
        append_formatted(
            text,
            "          through the layers left empty: outside, the object lies on a support, on itself or on the bed "
            "at most %s farther down\n",
            many(r.settings.support_gap_layers, "layer").c_str());
    if (r.settings.bed_only)
        text += "          on the bed alone: external supports stand on each other, nowhere on the object\n";
}

/// The first layers of which something is refuted, as geometry and as print.
void append_refuted(std::string& text, const RunReport& r) {
    constexpr int most = 5;
    if (!r.verdict.proved)
        append_formatted(text, "NOT PROVED  %zu of %zu layers are not supported:\n", r.verdict.layers_refuted.size(),
                         r.layers.size());
    int shown = 0;
    for (const LayerReport& layer : r.layers) {
        if (layer.verdict.supported || shown++ >= most) continue;
        if (const auto& hole = layer.verdict.internal ? layer.verdict.internal : layer.verdict.external)
            append_formatted(text, "  layer %d: %.3g to %.3g mm2, among them (%.6f, %.6f) mm\n", layer.layer,
                             hole->area_lo, hole->area_hi, hole->witness[0], hole->witness[1]);
        else if (is_of_slices(layer))
            append_formatted(text, "  %s\n", layer.verdict.malformed.c_str());
        else
            append_formatted(text, "  layer %d: %s\n", layer.layer, layer.verdict.malformed.c_str());
    }
    if (r.verdict.print_proved) return;
    const double mm = r.verdict.print_unsupported_mm.hi;
    const std::string what = mm < 0.0005 ? "sides of tracks, no centre line," : fixed(mm, 3) + " mm";
    append_formatted(text, "%s  of what is extruded, %s on %zu of %zu layers hang in air:\n",
                     r.settings.gaps == Gaps::paper ? "warning " : "NOT PROVED", what.c_str(),
                     r.verdict.print_layers_refuted.size(), r.layers.size());
    int named = 0;
    for (const LayerReport& layer : r.layers)
        if (!layer.print.supported && named++ < most)
            append_formatted(text, "  layer %d, near (%.3f, %.3f) mm\n", layer.layer, layer.print.place[0],
                             layer.print.place[1]);
}

/// What lies outside the layer below and has no support there.
void append_outside(std::string& text, const RunReport& r, const Job& job) {
    const std::vector<ExternalOverhang>& overhangs = r.verdict.external_overhangs;
    if (r.settings.reach_of_object() > r.settings.support_radius && !overhangs.empty())
        append_formatted(text,
                         "warning   on %s there are crevices where the gap leaves no room for a support within rho; "
                         "listed %s\n",
                         layers_text(overhangs.size()).c_str(), where_listed(job, true).c_str());
    if (!r.verdict.layers_with_patches_in_gap.empty())
        append_formatted(text,
                         "warning   on %s the object is too thin to be printed as thin as it is, and its tracks come "
                         "nearer to a support than the gap\n",
                         layers_text(r.verdict.layers_with_patches_in_gap.size()).c_str());
    if (overhangs.empty() || r.settings.outside()) return;
    double area = 0;
    const ExternalOverhang* worst = &overhangs.front();
    for (const ExternalOverhang& o : overhangs) {
        area += o.area_hi_mm2;
        if (o.area_hi_mm2 > worst->area_hi_mm2) worst = &o;
    }
    const std::string at_most = area < 0.0005 ? "less than 0.001" : "at most " + fixed(area, area < 10 ? 3 : 0);
    append_formatted(text,
                     "warning   the outside overhangs on %s (%s mm2 in all, most on layer %d):\n"
                     "          no internal support can hold that (--support both does); listed %s\n",
                     layers_text(overhangs.size()).c_str(), at_most.c_str(), worst->layer,
                     where_listed(job, true).c_str());
}

void describe_verdict(std::string& text, const RunReport& r, const Job& job) {
    if (r.verdict.proved) append_proved(text, r);
    append_refuted(text, r);
    if (!r.verdict.proved || (!r.verdict.print_proved && r.settings.gaps != Gaps::paper)) append_advice(text, r);
    append_outside(text, r, job);
    if (const std::vector<int>& over = r.verdict.layers_over_narrow_places; !over.empty())
        append_formatted(
            text,
            "warning   what is extruded begins in the air on %s (the lowest is layer %d), over places of "
            "the slice\n"
            "          below that are too narrow for a closed perimeter; a finer --nozzle may print them\n",
            layers_text(over.size()).c_str(), over.front());
}

void append_walls(std::string& text, const RunReport& r) {
    if (r.totals.slenderness <= 0) return;
    const LayerReport& l = r.layers[static_cast<std::size_t>(r.totals.slenderest_layer)];
    append_formatted(text, "walls     most slender on layer %d at (%.1f, %.1f) mm: %.1f mm high, ", l.layer,
                     l.slender_at[0], l.slender_at[1], l.slender_standing_mm);
    if (l.slender_to_root_mm > 0)
        append_formatted(text, "%.1f mm from a root", l.slender_to_root_mm);
    else
        text += "a tree that stands free";
    append_formatted(text, ", ratio %.0f\n", l.slenderness);
}

/// Layers on which nothing is printed but skirt and brim.
void append_empty(std::string& text, const RunReport& r) {
    std::size_t empty = 0, under = 0;  // those, and those of them that have something printed above
    const LayerReport* lowest = nullptr;
    for (const LayerReport& layer : r.layers) {
        if (!layer.empty) {
            under = empty;
            continue;
        }
        ++empty;
        if (!lowest) lowest = &layer;
    }
    if (!lowest) return;
    append_formatted(
        text, "warning   nothing is printed on %zu of %s, without room for a track (the lowest is layer %d)%s\n", empty,
        layers_text(r.layers.size()).c_str(), lowest->layer, under > 0 ? ": what is above begins in the air" : "");
}

/// What of the model was left out or mended.
void append_mended(std::string& text, const RunReport& r, const Job& job) {
    if (r.totals.thin_places > 0)
        append_formatted(text,
                         "warning   %s too narrow for a track and not printed (%.2f mm2 in all); layers listed %s\n",
                         (many(r.totals.thin_places, "place") + (r.totals.thin_places == 1 ? " is" : " are")).c_str(),
                         r.totals.thin_area_mm2, where_listed(job, false).c_str());
    append_empty(text, r);
    if (r.totals.closings > 0)
        append_formatted(text, "warning   %s in open contours %s closed; listed %s\n",
                         many(r.totals.closings, "gap").c_str(), r.totals.closings == 1 ? "was" : "were",
                         where_listed(job, false).c_str());
    if (r.totals.layers_with_slivers_removed > 0)
        append_formatted(
            text, "warning   slits and slivers narrower than 0.4 um, as between parts that touch, are gone from %s\n",
            many(r.totals.layers_with_slivers_removed, "layer").c_str());
}

}  // namespace

std::string summary(const RunReport& r, const Job& job) {
    std::string text;
    append_formatted(text, "%s: %zu triangles, %.2f x %.2f x %.2f mm, ", r.input_path.c_str(), r.input.triangles,
                     r.input.size_mm[0], r.input.size_mm[1], r.input.size_mm[2]);
    // Both ways round, components would cancel out.
    const bool both_ways = r.input.inverted_components > 0 && r.input.inverted_components < r.input.components;
    if (!r.input.closed())
        text += "not closed, ";
    else if (!both_ways)
        append_formatted(text, "%.1f mm3, ", std::abs(r.input.volume_mm3));
    text += many(static_cast<long long>(r.input.components), "component");
    if (both_ways) append_formatted(text, " (%zu inverted)", r.input.inverted_components);
    append_formatted(text, ", %s\n", many(static_cast<long long>(r.layers.size()), "layer").c_str());
    describe_verdict(text, r, job);
    append_formatted(text, "material  %.1f mm3: shell and covers %.1f, supports %.1f (%.0f mm of track)",
                     r.totals.material_mm3, r.totals.shell_volume_mm3, r.totals.support_volume_mm3,
                     r.totals.support_printed_length_mm);
    if (r.settings.outside())
        append_formatted(text, ", external supports %.1f (%.0f mm)", r.totals.external_support_volume_mm3,
                         r.totals.external_support_printed_length_mm);
    append_formatted(text, "; %.2f m of filament, %.1f mm3\n", r.totals.filament_mm / 1000, r.totals.extruded_mm3);
    if (r.settings.length_bound)
        append_formatted(text,
                         "bound     whatever the method, supports rooted on the shell take %.0f mm of track or more; "
                         "here they take %.0f\n",
                         r.totals.support_length_bound_mm, r.totals.support_length_mm);
    append_formatted(text, "print     about %.0f min; %s, %.1f m, %s\n", r.totals.print_seconds / 60,
                     many(r.totals.travels, "travel").c_str(), r.totals.travel_mm / 1000,
                     many(r.totals.retractions, "retraction").c_str());
    append_walls(text, r);
    append_mended(text, r, job);
    append_formatted(text, "time      %.2f s on %d threads, %.0f MB\n", r.machine.seconds, r.machine.threads,
                     r.machine.peak_memory_mb);
    const std::pair<const char*, const std::optional<std::filesystem::path>&> written[] = {
        {"G-code", job.gcode}, {"report", job.report}, {"pictures", job.svg},
        {"mesh", job.mesh},    {"layers", job.layers}, {"page", job.html}};
    for (const auto& [name, path] : written)
        if (path) append_formatted(text, "%-9s %s\n", name, path->string().c_str());
    if (std::none_of(std::begin(written), std::end(written), [](const auto& file) { return file.second.has_value(); }))
        text += "nothing was written; -o FILE names the G-code\n";
    return text;
}

std::string verdict_text(const RunReport& r, const Job& job) {
    std::string text;
    describe_verdict(text, r, job);
    return text;
}

}  // namespace ribvault
