#include "ribvault/report/region_outline.hpp"

#include <cmath>
#include <numbers>

#include "ribvault/report/svg_path.hpp"

namespace ribvault {
namespace {

using Vector = std::array<double, 2>;

Vector middle(const std::array<std::array<double, 2>, 2>& enclosure) {
    return {(enclosure[0][0] + enclosure[0][1]) / 2, (enclosure[1][0] + enclosure[1][1]) / 2};
}

void append_pair(std::string& data, const Vector& p) { data.append(svg_number(p[0])).append(" ").append(svg_number(-p[1])); }

void append_piece(std::string& data, const BoundaryPiece& piece, const PrintedLayer& upper, const PrintedLayer& lower) {
    const Vector from = middle(piece.from), to = middle(piece.to);
    if (piece.curve == BoundaryPiece::Curve::line) {
        append_pair(data += 'L', to);
        return;
    }
    const PrintedTrack& track = (piece.upper ? upper : lower).tracks[piece.track];
    const auto& end = piece.end == 0 ? track.a : track.b;
    const Vector centre{end[0].get_d(), end[1].get_d()};
    const double start = std::atan2(from[1] - centre[1], from[0] - centre[0]), stop = std::atan2(to[1] - centre[1], to[0] - centre[0]);
    double turn = piece.left_turning ? stop - start : start - stop;
    if (turn < 0) turn += 2 * std::numbers::pi;
    const std::string radius = svg_number(piece.radius.get_d());
    const auto arc = [&](const Vector& p, double by) {
        data.append("A").append(radius).append(" ").append(radius).append(by > std::numbers::pi ? " 0 1" : " 0 0");
        append_pair(data.append(piece.left_turning ? " 0 " : " 1 "), p);
    };
    if (turn < 1e-6 && from == to) {  // a whole circle is two arcs
        arc({2 * centre[0] - from[0], 2 * centre[1] - from[1]}, 0);
        arc(to, 0);
    } else {
        arc(to, turn);
    }
}

}  // namespace

std::string outline_data(const UnsupportedRegion& region, const PrintedLayer& upper, const PrintedLayer& lower) {
    std::string data;
    for (const auto& chain : region.boundary) {
        if (chain.empty()) continue;
        append_pair(data += 'M', middle(chain.front().from));
        for (const BoundaryPiece& piece : chain) append_piece(data, piece, upper, lower);
        data += "z";
    }
    return data;
}

}  // namespace ribvault
