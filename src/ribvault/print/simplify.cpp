#include "ribvault/print/simplify.hpp"

#include <algorithm>
#include <boost/geometry/strategies/cartesian/distance_projected_point.hpp>
#include <boost/geometry/algorithms/simplify.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>

namespace ribvault {

Region simplify(const Region& region, Unit tolerance) {
    if (tolerance <= 0) return region;
    namespace bg = boost::geometry;
    using Vertex = bg::model::d2::point_xy<double>;  // holds coordinates of the lattice exactly
    Region simple;
    bg::model::linestring<Vertex> line, fewer;
    for (const Contour& contour : region) {
        line.clear(), fewer.clear();
        const auto first = static_cast<std::size_t>(std::min_element(contour.begin(), contour.end()) - contour.begin());
        for (std::size_t k = 0; k <= contour.size(); ++k) {
            const Point p = contour[(first + k) % contour.size()];
            line.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y));
        }
        bg::simplify(line, fewer, static_cast<double>(tolerance));
        if (fewer.size() < 4) {
            simple.push_back(contour);
            continue;
        }
        simple.emplace_back();
        for (std::size_t k = 0; k + 1 < fewer.size(); ++k)
            simple.back().push_back({static_cast<Unit>(fewer[k].x()), static_cast<Unit>(fewer[k].y())});
    }
    return simple;
}

}  // namespace ribvault
