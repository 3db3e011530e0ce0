// What a print's report sums up: layers, the worst place of every feature, the worst layers.
#include "ribvault/report/print_report.hpp"

#include <catch2/catch.hpp>

using namespace ribvault;

namespace {

HangingPiece piece(int feature, double distance, std::int64_t line) {
    HangingPiece p;
    p.feature = feature, p.line = line;
    p.distance_mm = {distance, distance};
    p.worst = {static_cast<double>(line), 2};
    return p;
}

HangingRegion region(double area) {
    HangingRegion r;
    r.area_mm2 = {area, area};
    return r;
}

HangingLayer layer_of(int number, bool supported, double hanging_mm = 0) {
    HangingLayer layer;
    layer.layer = number, layer.supported = supported;
    layer.unsupported_mm = {hanging_mm, hanging_mm};
    return layer;
}

}  // namespace

TEST_CASE("a layer with two heights counts once, and a feature's worst place is where it is farthest") {
    PrintReport report;
    report.features.resize(3);
    report.layers = {layer_of(0, true), layer_of(1, false, 3), layer_of(1, false, 4), layer_of(2, true),
                     layer_of(3, false, 5)};
    report.layers[1].pieces = {piece(0, 0.5, 10), piece(1, 2, 11)};
    report.layers[2].pieces = {piece(0, 0.9, 20)};
    report.layers[4].pieces = {piece(0, 0.9, 30), piece(1, 1, 31)};
    report.layers[1].regions = {region(0.25), region(0.5)};
    report.layers[4].regions = {region(1)};
    for (HangingLayer& layer : report.layers) layer.length_mm = 100;
    sum_up(report);
    CHECK_FALSE(report.supported);
    CHECK(report.layers_unsupported == 2);
    CHECK(report.length_mm == 500);
    CHECK(report.unsupported_mm.lo == Approx(12));
    CHECK(report.area_mm2.hi == Approx(1.75));
    CHECK(report.features[0].worst_mm.lo == 0.9);
    CHECK(report.features[0].worst_layer == 1);  // the first of two as far
    CHECK(report.features[0].worst_line == 20);
    CHECK(report.features[0].worst_at == std::array<double, 2>{20, 2});
    CHECK(report.features[1].worst_line == 11);
    CHECK(report.features[2].worst_layer == -1);
    const std::string json = to_json(report);
    CHECK(json.find("\"layers_unsupported\":[1,3]") != std::string::npos);
}

TEST_CASE("the worst layers come by area, then by length, then from below, and no more than asked for") {
    PrintReport report;
    report.layers = {layer_of(0, true),     layer_of(1, false, 1), layer_of(2, false, 9),
                     layer_of(3, false, 2), layer_of(4, false, 2), layer_of(5, false, 7)};
    report.layers[1].regions = {region(3)};
    report.layers[2].regions = {region(1), region(1)};
    for (const std::size_t k : {3u, 4u, 5u}) report.layers[k].pieces = {piece(0, 1, 1)};
    CHECK(worst_layers(report, 10) == std::vector<std::size_t>{1, 2, 5, 3, 4});
    CHECK(worst_layers(report, 2) == std::vector<std::size_t>{1, 2});
    CHECK(worst_layers({}, 2).empty());
}
