#include "ribvault/vault/detect_unsupported.hpp"

#include "ribvault/slice/lattice_clip.hpp"
#include "ribvault/vault/segment_grid.hpp"

namespace ribvault {
namespace {

/// Polygon around the stadium of radius r about s: 32 tangents to the two end discs.
Region circumscribed_stadium(const Segment& s, Unit r) {
    constexpr int corners = 32;
    const double radius = (static_cast<double>(r) + 2) / std::cos(M_PI / corners);
    Region around_ends;
    for (const Point centre : {s.a, s.b}) {
        Contour disc;
        for (int k = 0; k < corners; ++k) {
            const double angle = 2 * M_PI * (k + 0.5) / corners;
            disc.push_back({centre.x + round_to_lattice(radius * std::cos(angle)),
                            centre.y + round_to_lattice(radius * std::sin(angle))});
        }
        around_ends.push_back(std::move(disc));
    }
    const double l = length(s);
    if (l > 0) {
        const double nx = -static_cast<double>(s.b.y - s.a.y) / l * radius,
                     ny = static_cast<double>(s.b.x - s.a.x) / l * radius;
        const Point n{round_to_lattice(nx), round_to_lattice(ny)};
        around_ends.push_back({s.a - n, s.b - n, s.b + n, s.a + n});
    }
    return around_ends;
}

}  // namespace

Region unsupported_walls(const std::vector<Segment>& inherited, const SupportForest& propagated, const Region* within,
                         const Settings& settings) {
    if (inherited.empty() || (within && within->empty())) return {};
    const std::vector<Segment> walls = centre_lines(propagated);
    SegmentGrid grid(bounding_box(propagated), units_per_mm, settings.support_radius);
    for (std::uint32_t k = 0; k < walls.size(); ++k) grid.insert(k, walls[k]);

    Region stadiums;
    for (const Segment& piece : inherited) {
        const bool held = grid.any_near(piece.a, [&](std::uint32_t k) {
            return compare_distance(piece.a, walls[k], settings.support_radius) <= 0 &&
                   compare_distance(piece.b, walls[k], settings.support_radius) <= 0;
        });
        if (held) continue;
        for (Contour& contour : circumscribed_stadium(piece, settings.half_width()))
            stadiums.push_back(std::move(contour));
    }
    if (stadiums.empty()) return {};
    return within ? clip(ClipperLib::ctIntersection, *within, stadiums) : stadiums;
}

}  // namespace ribvault
