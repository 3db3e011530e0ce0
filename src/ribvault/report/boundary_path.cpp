#include "ribvault/report/boundary_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ribvault/report/svg_path.hpp"

namespace ribvault {
namespace {

struct Place {
    double x = 0, y = 0;
};

class Drawing {
public:
    Drawing(const RegionBoundary& boundary, YAxis y) : boundary_(boundary), up_(y == YAxis::up) {}

    void loop(const BoundaryLoop& loop) {
        move(start_of(loop.front()));
        for (const BoundaryPiece& piece : loop) piece.turn == 0 ? line(vertex(piece.to)) : arc(piece);
        text += 'Z';
    }
    std::string text;

private:
    Place vertex(std::size_t v) const {
        const BoundaryVertex& at = boundary_.vertices[v];
        return {(at.x[0] + at.x[1]) / 2, (at.y[0] + at.y[1]) / 2};
    }
    Place centre(const BoundaryPiece& piece) const {
        const BoundaryCurve& circle = boundary_.curves[piece.curve];
        return {circle.a[0].get_d(), circle.a[1].get_d()};
    }
    double radius(const BoundaryPiece& piece) const { return boundary_.curves[piece.curve].radius.get_d(); }
    Place start_of(const BoundaryPiece& piece) const {
        if (piece.from != BoundaryPiece::nowhere) return vertex(piece.from);
        const Place c = centre(piece);
        return {c.x + radius(piece), c.y};
    }

    /// In steps of at most 120 degrees, whose ends the two flags of an arc tell apart whatever the rounding.
    void arc(const BoundaryPiece& piece) {
        const Place c = centre(piece), from = start_of(piece);
        const double r = radius(piece), first = std::atan2(from.y - c.y, from.x - c.x);
        const int steps = std::max(1, static_cast<int>(std::ceil(piece.angle / (2 * std::numbers::pi / 3) - 1e-9)));
        std::string radii("A");
        radii += svg_number(r) + " " + svg_number(r) + ((piece.turn > 0) == up_ ? " 0 0 1 " : " 0 0 0 ");
        for (int k = 1; k <= steps; ++k) {
            const double angle = first + piece.turn * piece.angle * k / steps;
            const bool last = k == steps && piece.to != BoundaryPiece::nowhere;
            append(radii, last ? vertex(piece.to) : Place{c.x + r * std::cos(angle), c.y + r * std::sin(angle)});
        }
    }
    void move(Place p) {
        at_.clear();
        append("M", p);
    }
    void line(Place p) { append("L", p); }
    void append(const std::string& command, Place p) {
        std::string to = svg_number(p.x) + " " + svg_number(up_ ? p.y : -p.y);
        if (to == at_) return;
        text += command + to;
        at_ = std::move(to);
    }

    const RegionBoundary& boundary_;
    const bool up_;
    std::string at_;
};

}  // namespace

std::string boundary_data(const RegionBoundary& boundary, YAxis y) {
    Drawing drawing(boundary, y);
    for (const RegionComponent& component : boundary.components)
        for (const BoundaryLoop& loop : component.loops) drawing.loop(loop);
    return std::move(drawing.text);
}

}  // namespace ribvault
