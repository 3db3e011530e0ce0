#include "mesh/solids.hpp"
#include "ribvault/error.hpp"
#include "ribvault/mesh/read_mesh.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

struct Refusal {
    const char* file;
    ErrorKind kind;
    const char* place;
    const char* what;
};

/// tests/corpus/meshes: what each file is refused for.
const Refusal refusals[] = {
    {"all_degenerate.stl", ErrorKind::bad_geometry, ": ", "all 2 triangles have two corners at the same point"},
    {"ascii_infinite.stl", ErrorKind::bad_geometry, ", line 5: ", "'inf' is not a finite number"},
    {"ascii_quad.stl", ErrorKind::unreadable, ", line 7: ", "more than three corners"},
    {"ascii_unfinished.stl", ErrorKind::unreadable, ", line 6: ", "the file ends where 'vertex' should follow"},
    {"bad_transform.3mf", ErrorKind::unreadable, ", 3D/3dmodel.model: ", "not twelve numbers"},
    {"binary.off", ErrorKind::unreadable, ", line 1: ", "binary OFF is not read"},
    {"broken_xml.3mf", ErrorKind::unreadable, ", 3D/3dmodel.model, byte 433: ", "the XML is broken"},
    {"empty_build.3mf", ErrorKind::bad_geometry, ", 3D/3dmodel.model: ", "has no <item>"},
    {"endless_components.3mf", ErrorKind::unreadable, ", 3D/3dmodel.model: ", "nested without end"},
    {"flat.off", ErrorKind::bad_geometry, ": ", "no volume, all its points have the same z"},
    {"four_billion.ply", ErrorKind::unreadable, ", byte 226: ", "ends before all declared elements"},
    {"four_billion.stl", ErrorKind::unreadable, ", byte 80: ",
     "declares 4294967295 triangles, but the file's 100 bytes hold 0"},
    {"four_dimensions.off", ErrorKind::unreadable, ", line 1: ", "more than three coordinates"},
    {"header_only.stl", ErrorKind::bad_geometry, ": ", "no triangles"},
    {"index_beyond.3mf", ErrorKind::unreadable, ", object 1, triangle 0: ",
     "refers to vertex '4', but the object has 4"},
    {"index_beyond.obj", ErrorKind::unreadable, ", line 6: ", "refers to vertex 9, but the file has only 4"},
    {"index_beyond.off", ErrorKind::unreadable, ", line 8: ", "refers to vertex 4, but the file has only 4"},
    {"index_beyond.ply", ErrorKind::unreadable, ", line 14: ", "face 0 refers to vertex 7"},
    {"index_too_negative.obj", ErrorKind::unreadable, ", line 4: ", "refers to vertex -4, but only 3 precede it"},
    {"index_zero.obj", ErrorKind::unreadable, ", line 4: ", "vertex numbers from 1 on"},
    {"missing_faces.off", ErrorKind::unreadable, ", line 8: ", "the file ends where the number of a face's corners"},
    {"missing_object.3mf", ErrorKind::unreadable, ", 3D/3dmodel.model: ", "object '2' is used but not there"},
    {"nan.ply", ErrorKind::bad_geometry, " (vertex 0): ", "not a finite number"},
    {"nan.stl", ErrorKind::bad_geometry, ", triangle 2 (byte 184): ", "not a finite number"},
    {"negative_list.ply", ErrorKind::unreadable, ", line 14: ", "has the length -3"},
    {"no_z.ply", ErrorKind::unreadable, ", line 7: ", "the vertices have no number 'z'"},
    {"not_a_model.3mf", ErrorKind::unreadable, ", 3D/3dmodel.model: ", "no such part"},
    {"not_a_number.3mf", ErrorKind::unreadable, ", object 1, vertex 1: ", "x is not a number"},
    {"only_points.obj", ErrorKind::bad_geometry, ": ", "no triangles"},
    {"point_cloud.ply", ErrorKind::bad_geometry, ": ", "no triangles"},
    {"rubbish.dat", ErrorKind::unreadable, ": ", "neither content nor name"},
    {"rubbish.stl", ErrorKind::unreadable, ", byte 80: ", "declares 1176289204 triangles"},
    {"short_vertex.obj", ErrorKind::unreadable, ", line 2: ", "'v' needs three coordinates"},
    {"strips.ply", ErrorKind::unreadable, ", line 10: ", "triangle strips are not read"},
    {"text.xyz", ErrorKind::unreadable, ": ", "neither content nor name"},
    {"too_large_number.off", ErrorKind::bad_geometry, ", line 4: ", "'1e999' is not a finite number"},
    {"truncated.stl", ErrorKind::unreadable, ", byte 80: ", "declares 4 triangles, but the file's 254 bytes hold 3"},
    {"unknown_type.ply", ErrorKind::unreadable, ", line 4: ", "no type that PLY knows"},
    {"unknown_unit.3mf", ErrorKind::unreadable, ", 3D/3dmodel.model: ", "the unit 'parsec'"},
    {"web_page.stl", ErrorKind::unreadable, ", line 1: ", "starts with 'solid', this one does not"},
    {"word_for_number.off", ErrorKind::unreadable, ", line 4: ", "'x' stands where a coordinate should"},
};

void check_refused(const std::filesystem::path& file, ErrorKind kind, const std::string& place,
                   const std::string& what) {
    INFO(file);
    try {
        read_mesh(file);
        FAIL("was read");
    } catch (const Error& error) {
        const std::string message = error.what();
        INFO(message);
        CHECK(error.kind() == kind);
        CHECK(message.starts_with(file.string()));
        CHECK_THAT(message, Catch::Contains(place) && Catch::Contains(what) && Catch::Contains("; "));
        CHECK_THAT(message, !Catch::Contains("\n"));
    }
}

}  // namespace

TEST_CASE("each broken file of the corpus is refused for its own reason") {
    const std::filesystem::path corpus = std::filesystem::path(RIBVAULT_CORPUS) / "meshes";
    std::set<std::string> unexplained;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) unexplained.insert(entry.path().filename());
    for (const Refusal& refusal : refusals) {
        check_refused(corpus / refusal.file, refusal.kind, refusal.place, refusal.what);
        unexplained.erase(refusal.file);
    }
    CHECK(unexplained == std::set<std::string>{"solid_header.stl"});
    CHECK(read_mesh(corpus / "solid_header.stl").triangles.cols() == 4);
}

TEST_CASE("missing, empty, folder, no permission") {
    const TemporaryFolder folder;
    check_refused(folder.path() / "none.stl", ErrorKind::unreadable, ": ", "there is no such file");
    check_refused(folder.path(), ErrorKind::unreadable, ": ", "is a folder");
    check_refused(folder.write("empty.stl", ""), ErrorKind::unreadable, ": ", "the file is empty");
    if (geteuid() != 0) {  // nothing is closed to root
        const auto closed = folder.write("closed.stl", "solid");
        std::filesystem::permissions(closed, std::filesystem::perms::none);
        check_refused(closed, ErrorKind::unreadable, ": ", "cannot be opened");
    }
}

TEST_CASE("a facet of an STL text without its loop is not passed over") {
    const TemporaryFolder folder;
    const std::string
        loop = "outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
        damaged = "facet normal 0 0 1\ninner loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    check_refused(folder.write("a.stl", "solid a\n" + damaged + "facet normal 0 0 1\n" + loop + "endsolid\n"),
                  ErrorKind::unreadable, ", line ", "a facet without 'outer loop'");
    check_refused(folder.write("b.stl", "solid a\nfacet normal 0 0 1\nfacet normal 0 0 1\n" + loop + "endsolid\n"),
                  ErrorKind::unreadable, ", line ", "a facet without 'outer loop'");
}

TEST_CASE("a cut binary STL whose header says 'solid' is named as a binary one") {
    const TemporaryFolder folder;
    const std::string whole = binary_stl(box({0, 0, 0}, {1, 2, 3}), "solid cube");
    check_refused(folder.write("cut.stl", whole.substr(0, 600)), ErrorKind::unreadable,
                  ", byte 80: ", "declares 12 triangles, but the file's 600 bytes hold 10");
}

TEST_CASE("3MF that needs what is not read is refused, whatever else is in it") {
    const TemporaryFolder folder;
    const std::string cube = "<object id=\"1\">" + mesh_xml(weld(box({0, 0, 0}, {1, 1, 1}))) + "</object>";
    const auto with = [&](const std::string& attributes, const std::string& resources, const std::string& item) {
        std::string model = model_xml(resources, "<item objectid=\"" + item + "\"/>");
        model.insert(model.find("<model") + 6, " " + attributes);
        write_zip(folder.path() / "a.3mf", {{"3D/3dmodel.model", model}});
        return folder.path() / "a.3mf";
    };
    check_refused(
        with("requiredextensions=\"p b\" xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
             "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\"",
             cube, "1"),
        ErrorKind::unreadable, ", 3D/3dmodel.model: ", "beamlattice");
    check_refused(with("requiredextensions=\"x\"", cube, "1"), ErrorKind::unreadable, ", 3D/3dmodel.model: ", "'x'");
    check_refused(with("", cube + "<object id=\"2\"><booleanshape/></object>", "2"), ErrorKind::unreadable,
                  ", 3D/3dmodel.model: ", "object '2' is neither a mesh");
    CHECK(
        read_mesh(
            with("requiredextensions=\"p\" xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"",
                 cube, "1"))
            .triangles.cols() == 12);
}

TEST_CASE("a cut 3MF archive is named as such") {
    const TemporaryFolder folder;
    write_zip(folder.path() / "a.3mf", {{"3D/3dmodel.model", model_xml("", "")}});
    const std::string whole = content(folder.path() / "a.3mf");
    check_refused(folder.write("cut.3mf", whole.substr(0, whole.size() / 2)), ErrorKind::unreadable, ": ",
                  "ZIP archive of the 3MF file cannot be opened");
}
