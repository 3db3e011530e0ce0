// Candidate points: where a corner of the uncovered set can be (docs/verifier.md), constructed in any number type.
#pragma once

#include <optional>

#include "ribvault/verify/cover_problem.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault::verify {

/// A full circle (centre vertex a) or a full line at signed distance side * radius to the left of the line from a to b;
/// `from_material` tells M's curves from K's.
struct Curve {
    bool line = false;
    int a = 0, b = 0;
    int side = 0;  ///< 1: left, -1: right, 0: the line itself
    Radius radius;
    bool from_material = false;
};

/// A vertex, the point of a disc farthest to the left, or a meeting point of two curves.
struct Candidate {
    enum class Kind { vertex, leftmost, meeting } kind = Kind::vertex;
    int vertex = 0;
    Radius radius;
    Curve first, second;
    int root = 0;  ///< which of the two meeting points; 0 when there is one
};

/// Which stage answered last.
enum class Stage { interval = 0, rational = 1, algebraic = 2 };

/// A candidate point of a problem: certified enclosure, exact value on demand, and the highest stage that was needed.
struct Located {
    const CoverProblem* problem = nullptr;
    Candidate candidate;
    Interval x, y;
    Stage stage = Stage::interval;
    bool rational_tried = false;
    std::optional<Vec<Rational>> rational;
};

/// Coordinates in NT. Throws NotRational when NT = Rational cannot hold them.
template <class NT>
Vec<NT> locate(const CoverProblem& problem, const Candidate& candidate);

/// The candidate with its enclosure by intervals. Under upward rounding.
Located located(const CoverProblem& problem, const Candidate& candidate);

/// Makes the enclosure as tight as doubles allow, by exact evaluation; raises the stage.
void refine(Located& v);

/// How two curves meet: 0, 1 (tangent circles or lines, or two crossing lines) or 2 points; concentric circles and
/// parallel lines: 0 (what happens along a shared piece is seen at its ends, which are other candidates). Exact; raises
/// `stage`.
int meeting_points(const CoverProblem& problem, const Curve& c1, const Curve& c2, Stage& stage);

/// The rational value if the candidate has one, computed once.
const Vec<Rational>* rational_value(Located& v);

/// Exact sign of f at the point: intervals, then rationals, then algebraic numbers; `unknown` when `last` stops it.
/// f is a generic callable: f.template operator()<NT>(const Vec<NT>& point) -> NT.
template <class F>
int sign_at(Located& v, const F& f, Stage last);

template <class F>
[[gnu::noinline]] int exact_sign_at(Located& v, const F& f) {
    CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    if (const Vec<Rational>* q = rational_value(v)) {
        try {
            const int s = sign_of(f.template operator()<Rational>(*q));
            if (v.stage < Stage::rational) v.stage = Stage::rational;
            return s;
        } catch (const NotRational&) {  // the point is rational, what f compares it with is not
        }
    }
    v.stage = Stage::algebraic;
    return sign_of(f.template operator()<Algebraic>(locate<Algebraic>(*v.problem, v.candidate)));
}

template <class F>
int sign_at(Located& v, const F& f, Stage last) {
    const int s = sign_of(f.template operator()<Interval>(Vec<Interval>{v.x, v.y}));
    return s != unknown || last == Stage::interval ? s : exact_sign_at(v, f);
}

}  // namespace ribvault::verify
