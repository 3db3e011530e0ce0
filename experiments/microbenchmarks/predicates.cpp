#include <benchmark/benchmark.h>

#include <stdexcept>

#include "ribvault/exact/predicates.hpp"
#include "ribvault/verify/point_signs.hpp"
#include "stages.hpp"

using namespace ribvault;

namespace {

void lattice_predicates() {
    const Segment s{{0, 0}, {3000000, 1000000}}, t{{100000, -200000}, {2000000, 1900000}};
    const Point p{1000000, 500000};
    benchmark::RegisterBenchmark("orientation", [=](benchmark::State& state) {
        for (auto _ : state) {
            Point q = p;
            benchmark::DoNotOptimize(q);
            benchmark::DoNotOptimize(orientation(s.a, s.b, q));
        }
    });
    benchmark::RegisterBenchmark("distance to segment against radius", [=](benchmark::State& state) {
        for (auto _ : state) {
            Point q = p;
            benchmark::DoNotOptimize(q);
            benchmark::DoNotOptimize(compare_distance(q, s, 20000));
        }
    });
    const auto distances = [](const char* name, SquaredDistance a, SquaredDistance b) {
        benchmark::RegisterBenchmark(name, [=](benchmark::State& state) {
            for (auto _ : state) {
                SquaredDistance c = a;
                benchmark::DoNotOptimize(c);
                benchmark::DoNotOptimize(compare(c, b));
            }
        });
    };
    distances("two distances, triage decides", squared_distance(p, s), squared_distance(p, t));
    distances("two distances, equal", squared_distance(p, s), squared_distance(p, s));
}

/// The verifier's question, whether a point is in a stadium, where each of its three stages is the one that decides.
void stadium_predicates() {
    using namespace verify;
    static std::vector<Vertex> vertices;
    for (const Point p :
         {Point{0, 0}, Point{300000, 400000}, Point{4000000, -3000000}, Point{-4000000, 3000000}, Point{650000, 0}})
        vertices.push_back(lattice_vertex(p));
    // 3 : 4 : 5, in sevenths: at its distance exactly, and neither it nor the distance is a binary float.
    static const Vec<Rational> sevenths{Rational(300000, 7), Rational(400000, 7)};
    static const ExactRadius distance{Rational(500000, 7), enclosure(Rational(500000, 7))};
    vertices.push_back(rational_vertex(sevenths));
    static const CoverProblem problem{vertices, {}, {}, {}, {}, false};
    const auto question = [](const char* name, const Candidate& candidate, const Stadium& stadium, Side answer,
                             Stage stage) {
        benchmark::RegisterBenchmark(name, [=](benchmark::State& state) {
            const CGAL::Protect_FPU_rounding<true> upward;
            for (auto _ : state) {
                Located v = located(problem, candidate);
                if (side_of_stadium(v, stadium, Stage::algebraic) != answer || v.stage != stage)
                    throw std::logic_error(name);
                benchmark::DoNotOptimize(v);
            }
        });
    };
    Candidate far, on, meeting;
    far.vertex = 4, on.vertex = 5;
    // The circles of radius 3 mm around (0, 0) and (3, 4) meet where coordinates are irrational, on their bisector: on
    // the side of the stadium of radius 2.5 mm around its parallel through (0, 0).
    meeting.kind = Candidate::Kind::meeting;
    meeting.root = 1;
    meeting.first = {false, 0, 0, 0, 300000.0, false};
    meeting.second = {false, 1, 1, 0, 300000.0, false};
    question("point in stadium, intervals decide", far, {0, 0, 200000.0}, Side::outside, Stage::interval);
    question("point in stadium, rationals decide", on, {0, 0, Radius(distance)}, Side::on, Stage::rational);
    question("point in stadium, algebraic numbers decide", meeting, {2, 3, 250000.0}, Side::on, Stage::algebraic);
}

}  // namespace

void register_predicates() {
    lattice_predicates();
    stadium_predicates();
}
