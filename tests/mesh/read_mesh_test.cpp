#include <limits>

#include "mesh/solids.hpp"
#include "ribvault/error.hpp"
#include "ribvault/mesh/examine_mesh.hpp"
#include "ribvault/mesh/read_mesh.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// Every format and variant of it, by file name.
std::map<std::string, std::string> in_every_format(const std::vector<Triangle>& triangles,
                                                   const TemporaryFolder& folder) {
    const Mesh mesh = weld(triangles);
    std::map<std::string, std::string> files = {
        {"binary.stl", binary_stl(triangles)},
        {"solid_header.stl", binary_stl(triangles, "solid cube")},
        {"ascii.stl", ascii_stl(triangles)},
        {"windows.stl", ascii_stl(triangles, "\r\n")},
        {"mac.stl", ascii_stl(triangles, "\r")},
        {"plain.obj", obj(mesh)},
        {"negative.obj", obj(mesh, true)},
        {"plain.off", off(mesh)},
        {"coloured.off", off(mesh, "COFF", " 0.5 0.5 0.5 1#red")},
        {"normals.off", off(mesh, "NOFF", " 0 0 1")},
        {"ascii.ply", ply(mesh, "ascii")},
        {"little.ply", ply(mesh, "binary_little_endian")},
        {"big.ply", ply(mesh, "binary_big_endian")}};
    // Lines of the header that end in CR LF: the body begins behind both.
    for (const std::string format : {"ascii", "binary_little_endian"}) {
        std::string text = ply(mesh, format);
        const std::size_t body = text.find("end_header\n") + 11;
        std::string header;
        for (const char c : text.substr(0, body)) header += c == '\n' ? "\r\n" : std::string(1, c);
        files["windows_" + format + ".ply"] = header + text.substr(body);
    }
    const std::string object = "<object id=\"1\" type=\"model\">" + mesh_xml(mesh) + "</object>";
    write_zip(folder.path() / "zip.3mf", {{"3D/3dmodel.model", model_xml(object, "<item objectid=\"1\"/>")}});
    files["zip.3mf"] = content(folder.path() / "zip.3mf");
    return files;
}

}  // namespace

TEST_CASE("the same solid in every format is the same mesh") {
    const TemporaryFolder folder;
    // Floats, so that binary STL holds them too, one of them no short decimal.
    const auto cube = box({-1.5, 0.1f, -0.0}, {2, 3.25, 1e-3f});
    const Mesh expected = weld(cube);
    CHECK(expected.vertices.cols() == 8);
    for (const auto& [name, text] : in_every_format(cube, folder)) {
        INFO(name);
        const Mesh mesh = read_mesh(folder.write(name, text));
        CHECK(mesh.vertices.cols() == 8);
        CHECK(mesh.triangles.cols() == 12);
        CHECK(mesh.degenerate_triangles == 0);
        CHECK(coordinates(mesh) == coordinates(expected));
    }
}

TEST_CASE("the content tells the format, whatever the name says") {
    const TemporaryFolder folder;
    const auto cube = box({0, 0, 0}, {1, 2, 3});
    for (const auto& [name, text] : in_every_format(cube, folder)) {
        INFO(name);
        for (const std::string other : {"x.stl", "x.obj", "x.off", "x.ply", "x.3mf", "x"})
            CHECK(coordinates(read_mesh(folder.write(other, text))) == coordinates(weld(cube)));
    }
}

TEST_CASE("every prefix of a file is read or refused") {
    const TemporaryFolder folder;
    const auto solid = box({0, 0, 0}, {1, 2, 3});
    for (const auto& [name, text] : in_every_format(solid, folder)) {
        INFO(name);
        std::size_t refused = 0;
        for (std::size_t length = 0; length < text.size(); ++length) {
            try {
                read_mesh(folder.write(name, text.substr(0, length)));
            } catch (const Error& error) {
                ++refused;
                REQUIRE(std::string(error.what()).starts_with((folder.path() / name).string()));
                REQUIRE((error.kind() == ErrorKind::unreadable || error.kind() == ErrorKind::bad_geometry));
            }
        }
        // Formats without an end mark are complete a little before the end, and OBJ from some face on.
        CHECK(refused >= text.size() / 2);
        if (name.ends_with("3mf") || name == "binary.stl" || name == "big.ply") CHECK(refused == text.size());
    }
}

TEST_CASE("changed bytes are read or refused") {
    const TemporaryFolder folder;
    const auto solid = box({0, 0, 0}, {1, 2, 3});
    std::uint32_t random = 12345;
    const auto next = [&] { return random = random * 1664525u + 1013904223u, random >> 8; };
    for (const auto& [name, text] : in_every_format(solid, folder)) {
        INFO(name);
        for (int round = 0; round < 300; ++round) {
            std::string changed = text;
            for (int k = 0; k < 1 + round % 3; ++k) changed[next() % changed.size()] = static_cast<char>(next());
            try {
                const Mesh mesh = read_mesh(folder.write(name, changed));
                REQUIRE(mesh.triangles.minCoeff() >= 0);
                REQUIRE(mesh.triangles.maxCoeff() < mesh.vertices.cols());
                REQUIRE(mesh.vertices.allFinite());
                examine(mesh, Placement{});
            } catch (const Error&) {
            }
        }
    }
}

TEST_CASE("decimals become the nearest double") {
    const TemporaryFolder folder;
    const Mesh mesh = read_mesh(folder.write("a.off", "OFF\n4 4 0\n0.1 +1e-3 -0\n9007199254740993 0 0\n1e-400 1 0\n"
                                                      "0 0 5e-324\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"));
    CHECK(mesh.vertices(0, 0) == 0.1);
    CHECK(mesh.vertices(1, 0) == 1e-3);
    CHECK(!std::signbit(mesh.vertices(2, 0)));
    CHECK(mesh.vertices(0, 1) == 9007199254740992.0);
    CHECK(mesh.vertices(0, 2) == 0);
    CHECK(mesh.vertices(2, 3) == std::numeric_limits<double>::denorm_min());
}

TEST_CASE("equal vertices are welded, -0 is 0, neighbours stay apart, unused ones go") {
    const TemporaryFolder folder;
    const double next = std::nextafter(1.0, 2.0);
    const Mesh mesh = read_mesh(folder.write(
        "a.obj", "v 77 77 77\nv 0 0 0\nv -0 -0.0 0\nv 1 0 0\nv " + shortest(next) + " 0 0\nv 0 1 0\nv 0 0 1\n"
                 "f 2 6 4\nf 3 5 7\nf 2 3 4\n"));
    CHECK(mesh.vertices.cols() == 5);
    CHECK(mesh.triangles.cols() == 2);
    CHECK(mesh.degenerate_triangles == 1);
    CHECK(mesh.triangles(0, 0) == mesh.triangles(0, 1));
    CHECK(mesh.vertices.maxCoeff() == next);
}

TEST_CASE("polygons are fans, convex or not") {
    const TemporaryFolder folder;
    // An L-shaped prism, 3 unit squares by 1, whose first corner does not see all others.
    const std::string prism = "OFF\n12 8 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n"
                              "0 0 1\n2 0 1\n2 1 1\n1 1 1\n1 2 1\n0 2 1\n6 1 0 5 4 3 2\n6 7 8 9 10 11 6\n"
                              "4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n";
    const MeshFacts facts = examine(read_mesh(folder.write("l.off", prism)), Placement{});
    CHECK(facts.triangles == 20);
    CHECK(facts.closed());
    CHECK(facts.volume_mm3 == Approx(3));
}

TEST_CASE("OBJ: continued lines, faces before vertices") {
    const TemporaryFolder folder;
    const Mesh mesh = read_mesh(folder.write("a.obj", "f 1 3 2\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                                      "f 1 \\\n 2 4\nf 2 3 4\nf 3 1 4"));
    CHECK(mesh.triangles.cols() == 4);
    CHECK(examine(mesh, Placement{}).volume_mm3 == Approx(1.0 / 6));
}

TEST_CASE("3MF: build items, components, transforms, units, other parts") {
    const TemporaryFolder folder;
    const std::string unit_cube = mesh_xml(weld(box({0, 0, 0}, {1, 1, 1})));
    const auto read = [&](const std::map<std::string, std::string>& parts) {
        write_zip(folder.path() / "a.3mf", parts);
        return read_mesh(folder.path() / "a.3mf");
    };
    SECTION("units are converted to millimetres") {
        for (const auto& [unit, mm] : std::map<std::string, double>{
                 {"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10},
                 {"inch", 25.4},    {"foot", 304.8},   {"meter", 1000}}) {
            const Mesh mesh = read({{"3D/3dmodel.model", model_xml("<object id=\"1\">" + unit_cube + "</object>",
                                                                   "<item objectid=\"1\"/>", unit)}});
            CHECK(mesh.vertices.maxCoeff() == mm);
        }
    }
    SECTION("an item's transform follows its component's") {
        const Mesh mesh = read({{"3D/3dmodel.model",
            model_xml("<object id=\"1\">" + unit_cube + "</object><object id=\"2\"><components>"
                      "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/>"
                      "<component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 5\"/></components></object>",
                      "<item objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 0 0 1\"/><item objectid=\"1\"/>")}});
        const auto expected = box({20, 0, 1}, {22, 2, 3}) + box({-2, 0, 11}, {0, 2, 13}) + box({0, 0, 0}, {1, 1, 1});
        const MeshFacts facts = examine(mesh, Placement{});
        CHECK(facts.components == 3);
        CHECK(facts.volume_mm3 == Approx(17));
        CHECK(mesh.vertices.rowwise().minCoeff() == weld(expected).vertices.rowwise().minCoeff());
        CHECK(mesh.vertices.rowwise().maxCoeff() == weld(expected).vertices.rowwise().maxCoeff());
    }
    SECTION("a mirrored object keeps its outside") {
        const Mesh mesh = read({{"3D/3dmodel.model",
            model_xml("<object id=\"1\">" + unit_cube + "</object>",
                      "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>")}});
        CHECK(examine(mesh, Placement{}).volume_mm3 == Approx(1));
    }
    SECTION("objects that are no model are left out") {
        const Mesh mesh = read({{"3D/3dmodel.model",
            model_xml("<object id=\"1\">" + unit_cube + "</object>"
                      "<object id=\"2\" type=\"support\">" + unit_cube + "</object>",
                      "<item objectid=\"1\"/><item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 9 0 0\"/>")}});
        CHECK(mesh.triangles.cols() == 12);
    }
    SECTION("items that the user has switched off are left out") {
        const auto with = [&](const char* first, const char* second) {
            const std::string item = "<item objectid=\"1\" printable=\"";
            return read({{"3D/3dmodel.model", model_xml("<object id=\"1\">" + unit_cube + "</object>",
                                                        item + first + "\"/>" + item + second +
                                                            "\" transform=\"1 0 0 0 1 0 0 0 1 9 0 0\"/>")}});
        };
        CHECK(with("1", "1").triangles.cols() == 24);
        CHECK(with("1", "0").triangles.cols() == 12);
        CHECK_THROWS_WITH(with("0", "0"),
                          Catch::Matchers::Contains("all items of the <build> are marked as not printable"));
    }
    SECTION("the relations name the model, the production extension names further parts") {
        const Mesh mesh = read(
            {{"_rels/.rels", "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
                             "<Relationship Target=\"/Thumb.png\" Id=\"r0\" Type=\"http://x/thumbnail\"/>"
                             "<Relationship Target=\"/3D/main.model\" Id=\"r1\" "
                             "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
             {"3D/main.model", model_xml("<object id=\"1\"><components><component p:path=\"/3D/Objects/part.model\" "
                                         "objectid=\"7\"/></components></object>", "<item objectid=\"1\"/>")},
             {"3D/Objects/part.model", model_xml("<object id=\"7\">" + unit_cube + "</object>", "")}});
        CHECK(mesh.triangles.cols() == 12);
    }
}
