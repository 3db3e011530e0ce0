#include "ribvault/print/islands.hpp"

#include <limits>

#include "ribvault/exact/predicates.hpp"

namespace ribvault {
namespace {

/// By the parity of crossings to the right; exact.
bool contains(const Contour& contour, Point p) {
    bool inside = false;
    for (std::size_t i = 0, n = contour.size(), j = n - 1; i < n; j = i++) {
        const Point a = contour[j], b = contour[i];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        const int side = orientation(a, b, p);
        if ((side > 0) == (b.y > a.y) && side != 0) inside = !inside;
    }
    return inside;
}

}  // namespace

Islands::Islands(const Region& region) {
    for (const Contour& contour : region) {
        const double area = signed_area({contour});
        if (area > 0) outer_.push_back({&contour, bounding_box({contour}), area});
    }
}

std::size_t Islands::of(Point p) const {
    std::size_t best = 0;
    if (outer_.size() < 2) return best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < outer_.size(); ++k) {
        const Outer& o = outer_[k];
        if (o.area >= least || p.x < o.box.lo.x || p.x > o.box.hi.x || p.y < o.box.lo.y || p.y > o.box.hi.y) continue;
        if (contains(*o.contour, p)) best = k, least = o.area;
    }
    return best;
}

}  // namespace ribvault
