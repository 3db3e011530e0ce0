// Walls are closed solids of the right volume at the right height, in both formats.
#include "ribvault/report/write_mesh.hpp"

#include <zip.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <random>

#include "print/random_forest.hpp"
#include "report/scratch_folder.hpp"
#include "ribvault/mesh/examine_mesh.hpp"
#include "ribvault/mesh/read_mesh.hpp"

using namespace ribvault;
using test::ScratchFolder;

namespace {

constexpr Unit mm = units_per_mm;

std::filesystem::path write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

std::string stl(const std::string& facets) {
    return stl_header(static_cast<std::uint32_t>(facets.size() / 50)) + facets;
}

/// The model part of a 3MF package.
std::string model_part(const std::filesystem::path& package) {
    int error = 0;
    const std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open(package.c_str(), ZIP_RDONLY, &error),
                                                                 &zip_discard);
    REQUIRE(archive);
    CHECK(zip_name_locate(archive.get(), "[Content_Types].xml", 0) >= 0);
    CHECK(zip_name_locate(archive.get(), "_rels/.rels", 0) >= 0);
    zip_stat_t stat;
    REQUIRE(zip_stat(archive.get(), "3D/3dmodel.model", 0, &stat) == 0);
    std::string xml(stat.size, ' ');
    zip_file_t* file = zip_fopen(archive.get(), "3D/3dmodel.model", 0);
    REQUIRE(file);
    CHECK(zip_fread(file, xml.data(), xml.size()) == static_cast<zip_int64_t>(xml.size()));
    zip_fclose(file);
    return xml;
}

SupportForest star() {
    SupportForest forest(4);
    forest[0] = {{0, 0}, true};
    forest[1] = {{10 * mm, 0}, false}, forest[2] = {{0, 7 * mm}, false}, forest[3] = {{-3 * mm, -4 * mm}, false};
    for (std::size_t k = 1; k < 4; ++k) add_edge(0, k, forest);
    return forest;
}

}  // namespace

TEST_CASE("every wall is a closed solid, outwards oriented, of length times width times height") {
    std::mt19937_64 random(11);
    for (int round = 0; round < 10; ++round) {
        const SupportForest forest = test::random_forest(random, 4, 20, mm / 10, 3 * mm, 0);
        std::string facets;
        append_walls(forest, 40000, 60000, Settings(), facets);
        REQUIRE(facets.size() % 50 == 0);
        using Corner = std::array<float, 3>;
        std::map<std::pair<Corner, Corner>, int> edges_used;
        double volume = 0;
        for (std::size_t at = 0; at < facets.size(); at += 50) {
            std::array<Corner, 3> c;
            std::memcpy(&c, facets.data() + at + 12, 36);
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK((c[k][2] == 0.4f || c[k][2] == 0.6f));
                ++edges_used[{c[k], c[(k + 1) % 3]}];
                --edges_used[{c[(k + 1) % 3], c[k]}];
            }
            const auto x = [&](std::size_t k, std::size_t axis) { return static_cast<double>(c[k][axis]); };
            volume +=
                (x(0, 0) * (x(1, 1) * x(2, 2) - x(2, 1) * x(1, 2)) + x(0, 1) * (x(1, 2) * x(2, 0) - x(2, 2) * x(1, 0)) +
                 x(0, 2) * (x(1, 0) * x(2, 1) - x(2, 0) * x(1, 1))) /
                6;
        }
        for (const auto& [edge, balance] : edges_used) REQUIRE(balance == 0);
        CHECK(volume == Approx(ribvault::length(forest) / mm * 0.4 * 0.2).epsilon(1e-4));
    }
}

TEST_CASE("a wall reaches half the track's width to either side of its segment, and not beyond its ends") {
    SupportForest forest(2);
    forest[0] = {{0, 0}, true}, forest[1] = {{3 * mm, 4 * mm}, false};
    add_edge(0, 1, forest);
    std::string facets;
    append_walls(forest, 0, 30000, Settings(), facets);
    for (std::size_t at = 0; at < facets.size(); at += 50)
        for (std::size_t k = 0; k < 3; ++k) {
            float p[3];
            std::memcpy(p, facets.data() + at + 12 + 12 * k, 12);
            const double along = 0.6 * p[0] + 0.8 * p[1], across = 0.6 * p[1] - 0.8 * p[0];
            CHECK(std::abs(across) == Approx(0.2).margin(1e-6));
            CHECK((std::abs(along) < 1e-6 || std::abs(along - 5) < 1e-6));
        }
}

TEST_CASE("STL and 3MF read back as the same solids, in mm") {
    const ScratchFolder folder;
    std::string facets;
    append_walls(star(), 0, 20000, Settings(), facets);
    append_walls(star(), 20000, 40000, Settings(), facets);
    for (const auto& file :
         {write(folder / "walls.stl", stl(facets)), write(folder / "walls.3mf", walls_3mf(facets))}) {
        INFO(file);
        const MeshFacts facts = examine(read_mesh(file), Placement());
        CHECK(facts.triangles == facets.size() / 50);
        CHECK(facts.closed());
        CHECK(facts.volume_mm3 == Approx(2 * (10 + 7 + 5) * 0.4 * 0.2).epsilon(1e-4));
        CHECK(facts.size_mm[2] == Approx(0.4));
    }
}

TEST_CASE("a 3MF is closed by its vertex numbers, each edge used once in either direction, also where walls touch") {
    const ScratchFolder folder;
    std::string facets;
    append_walls(star(), 0, 20000, Settings(), facets);
    append_walls(star(), 20000, 40000, Settings(), facets);
    pugi::xml_document document;
    REQUIRE(document.load_string(model_part(write(folder / "walls.3mf", walls_3mf(facets))).c_str()));
    const pugi::xml_node mesh = document.child("model").child("resources").child("object").child("mesh");
    const auto vertices = mesh.child("vertices").children("vertex");
    CHECK(std::distance(vertices.begin(), vertices.end()) == 6 * 8);
    std::map<std::pair<int, int>, int> used;
    for (const pugi::xml_node triangle : mesh.child("triangles").children("triangle")) {
        const std::array<int, 3> v{triangle.attribute("v1").as_int(-1), triangle.attribute("v2").as_int(-1),
                                   triangle.attribute("v3").as_int(-1)};
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(v[k] >= 0);
            CHECK(v[k] < 6 * 8);
            ++used[{v[k], v[(k + 1) % 3]}];
        }
    }
    CHECK(used.size() == 6 * 36);
    for (const auto& [edge, times] : used) {
        CHECK(times == 1);
        CHECK(used.count({edge.second, edge.first}) == 1);
    }
}

TEST_CASE("a wall of several tracks is as wide as these together") {
    const ScratchFolder folder;
    SupportForest forest = star();
    for (auto [v, end] = vertices(forest); v != end; ++v) forest[*v].wide = true;
    const auto far_root = add_vertex({.at = {0, -20 * mm}, .root = true}, forest),
               far_tip = add_vertex({.at = {0, -24 * mm}}, forest);
    add_edge(far_root, far_tip, forest);
    for (const int lines : {1, 2, 3}) {
        Settings settings;
        settings.wall_lines = lines;
        std::string facets;
        append_walls(forest, 0, 20000, settings, facets);
        const MeshFacts facts = examine(read_mesh(write(folder / "walls.stl", stl(facets))), Placement());
        CHECK(facts.closed());
        CHECK(facts.volume_mm3 == Approx(((10 + 7 + 5) * 0.4 * lines + 4 * 0.4) * 0.2).epsilon(1e-4));
    }
}

TEST_CASE("a segment without length is no wall") {
    SupportForest forest(3);
    forest[0] = {{mm, mm}, true}, forest[1] = {{mm, mm}, false}, forest[2] = {{2 * mm, mm}, true};
    add_edge(0, 1, forest);
    std::string facets;
    append_walls(forest, 0, 20000, Settings(), facets);
    CHECK(facets.empty());
}

TEST_CASE("the STL header is 80 bytes, does not begin with 'solid', and ends with the little-endian count") {
    const std::string header = stl_header(0x01020304);
    REQUIRE(header.size() == 84);
    CHECK_FALSE(header.starts_with("solid"));
    CHECK(header.substr(80) == std::string("\x04\x03\x02\x01"));
}

TEST_CASE("equal walls give equal files") {
    std::string facets;
    append_walls(star(), 0, 20000, Settings(), facets);
    CHECK(walls_3mf(facets) == walls_3mf(facets));
}

TEST_CASE("no supports, no walls") {
    std::string facets;
    append_walls(SupportForest(), 0, 20000, Settings(), facets);
    CHECK(facets.empty());
    const ScratchFolder folder;
    pugi::xml_document document;
    REQUIRE(document.load_string(model_part(write(folder / "walls.3mf", walls_3mf(facets))).c_str()));
    CHECK_FALSE(document.child("model").child("resources").child("object"));
    CHECK_FALSE(document.child("model").child("build").child("item"));
}
