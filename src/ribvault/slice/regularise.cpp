#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>

#include "ribvault/slice/nest_contours.hpp"

namespace ribvault {
namespace {

struct FaceState {
    bool reached = false;
    int winding = 0;
};

using SegmentTraits = CGAL::Arr_segment_traits_2<ExactKernel>;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<SegmentTraits, int>;
using Arrangement = CGAL::Arrangement_2<Traits, CGAL::Arr_face_extended_dcel<Traits, FaceState>>;

/// By how much the winding number grows from the right to the left of a halfedge.
int step_over(Arrangement::Halfedge_const_handle halfedge, const std::vector<char>& left_to_right) {
    int step = 0;
    for (auto data = halfedge->curve().data().begin(); data != halfedge->curve().data().end(); ++data)
        step += left_to_right[static_cast<std::size_t>(*data)] ? 1 : -1;
    return halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT ? step : -step;
}

template <class Circulator, class Visit>
void around(Circulator first, Visit&& visit) {
    Circulator current = first;
    do visit(current);
    while (++current != first);
}

void wind(Arrangement& arrangement, const std::vector<char>& left_to_right) {
    std::vector<Arrangement::Face_handle> open{arrangement.unbounded_face()};
    open.back()->data().reached = true;
    const auto cross = [&](Arrangement::Halfedge_handle halfedge) {
        const Arrangement::Face_handle here = halfedge->face(), there = halfedge->twin()->face();
        if (there->data().reached) return;
        there->data() = {true, here->data().winding - step_over(halfedge, left_to_right)};
        open.push_back(there);
    };
    while (!open.empty()) {
        const Arrangement::Face_handle face = open.back();
        open.pop_back();
        for (auto c = face->outer_ccbs_begin(); c != face->outer_ccbs_end(); ++c) around(*c, cross);
        for (auto c = face->inner_ccbs_begin(); c != face->inner_ccbs_end(); ++c) around(*c, cross);
    }
}

template <class Circulator>
ExactPolygon polygon_around(Circulator first) {
    ExactPolygon polygon;
    around(first, [&](Arrangement::Halfedge_const_handle halfedge) {
        CGAL::exact(halfedge->target()
                        ->point());  // before threads share it: what asks for it later changes its enclosure (Slice)
        polygon.push_back(halfedge->target()->point());
    });
    return polygon;
}

}  // namespace

ExactPolygons regularise(const std::vector<ExactContour>& contours) {
    std::vector<Traits::Curve_2> curves;
    std::vector<char> left_to_right;
    for (const ExactContour& c : contours)
        for (std::size_t i = 0; i < c.size(); ++i) {
            const ExactPoint &a = c[i], &b = c[i + 1 == c.size() ? 0 : i + 1];
            const CGAL::Comparison_result order = CGAL::compare_xy(a, b);
            if (order == CGAL::EQUAL) continue;
            curves.emplace_back(SegmentTraits::Curve_2(a, b), static_cast<int>(left_to_right.size()));
            left_to_right.push_back(order == CGAL::SMALLER);
        }
    Arrangement arrangement;
    insert(arrangement, curves.begin(), curves.end());
    wind(arrangement, left_to_right);

    // Edges inside the solid or outside it are no boundary; the faces on their two sides become one, of the same kind.
    std::vector<Arrangement::Halfedge_handle> inner;
    const auto solid = [](Arrangement::Face_const_handle face) { return face->data().winding != 0; };
    for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e)
        if (solid(e->face()) == solid(e->twin()->face())) inner.push_back(e);
    for (const Arrangement::Halfedge_handle halfedge : inner) arrangement.remove_edge(halfedge);

    ExactPolygons result;
    for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) {
        if (face->is_unbounded() || !solid(face)) continue;
        ExactPolygonWithHoles polygon(polygon_around(face->outer_ccb()));
        for (auto hole = face->inner_ccbs_begin(); hole != face->inner_ccbs_end(); ++hole)
            polygon.add_hole(polygon_around(*hole));
        result.polygons.push_back(std::move(polygon));
    }
    return result;
}

}  // namespace ribvault
