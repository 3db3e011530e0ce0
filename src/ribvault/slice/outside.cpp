#include "ribvault/slice/outside.hpp"

#include "ribvault/slice/lattice_clip.hpp"
#include "ribvault/slice/outline_reach.hpp"

namespace ribvault {
namespace {

Region complement(const Region& region, const Box& frame) {
    const Region all{{frame.lo, {frame.hi.x, frame.lo.y}, frame.hi, {frame.lo.x, frame.hi.y}}};
    return clip(ClipperLib::ctDifference, all, region);
}

}  // namespace

Cavity make_outside(const Slice& slice, const Box& frame, const Settings& s) {
    // On the object's side of the region's boundary is object, as it is shell on the shell's side of a cavity's.
    Cavity outside = make_cavity(slice.layer, complement(offset(slice.rounded, -clip_rounding), frame), s);
    outside.outside = true;
    return outside;
}

Region off_the_object(const std::vector<std::shared_ptr<const Slice>>& slices, const Box& frame, const Settings& s) {
    Region object;
    for (const auto& slice : slices)
        object = object.empty() ? slice->rounded : clip(ClipperLib::ctUnion, object, slice->rounded);
    // Arcs become chords of their own circle; the last of an arc may be half as long again as the others, so that it
    // cuts off 9/4 of the tolerance. Clipped ends and vertices are rounded by up to four lattice units after this; ten
    // keep them off.
    const double tolerance = static_cast<double>(s.slack) / 2;
    const Region kept_off =
        offset(object, static_cast<double>(s.standoff()) + 2.5 * tolerance + 10, ClipperLib::jtRound, tolerance);
    return uncross(complement(kept_off, frame));
}

Region overhang_outside(const Cavity& outside, const Cavity& outside_above, const Cavity& cavity_above,
                        const Settings& s, const Slice* slice, const Slice* slice_above) {
    Region hanging = clip(ClipperLib::ctDifference, outside.deep, outside_above.inner);
    if (s.bottom_layers == 0 && !hanging.empty() && !cavity_above.inner.empty())
        hanging = clip(ClipperLib::ctDifference, hanging, cavity_above.inner);
    if (!slice || !slice_above) return without_ties(hanging, outside, outside_above, s);
    OutlineReach reach(*slice_above->exact, *slice->exact, s.support_radius);
    return without_ties(hanging, outside, outside_above, s, [&](Box sliver) {
        sliver.grow(static_cast<Unit>(4 * clip_rounding));  // what rounding may have taken away
        return reach.holds_in(sliver);
    });
}

}  // namespace ribvault
