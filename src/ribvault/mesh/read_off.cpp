// OFF with the prefixes ST, C and N (texture, colour, normal: passed over); text only.
#include <algorithm>
#include <vector>

#include "ribvault/mesh/read_formats.hpp"
#include "ribvault/mesh/text_scanner.hpp"

namespace ribvault {
namespace {

void read_header(TextScanner& scan) {
    const std::string_view word = scan.token("'OFF'");
    if (word == "4OFF" || word == "nOFF" || word == "4nOFF")
        scan.fail("the points have more than three coordinates", "save the mesh as plain OFF");
    if (!word.ends_with("OFF")) scan.fail("an OFF file starts with 'OFF', this one does not", "check what the file is");
}

std::size_t count(TextScanner& scan, const char* what) {
    const std::int64_t value = scan.integer(what);
    if (value < 0) scan.fail(std::string("a negative number stands where ") + what + " should");
    return static_cast<std::size_t>(value);
}

}  // namespace

void read_off(const InputFile& file, MeshBuilder& mesh) {
    TextScanner scan(file, file.starts_with("\xef\xbb\xbf") ? 3 : 0, '#');
    read_header(scan);
    if (!scan.at_line_end()) {
        TextScanner ahead = scan;
        if (ahead.token("a count") == "BINARY")
            scan.fail("binary OFF is not read", "save the mesh as text OFF or as STL");
    }
    const std::size_t vertex_count = count(scan, "the number of vertices");
    if (scan.at_line_end()) scan.fail("the numbers of vertices and faces must stand on one line");
    const std::size_t face_count = count(scan, "the number of faces");
    scan.next_line();  // the number of edges, often wrong and never needed

    std::vector<int> vertices;
    vertices.reserve(std::min(vertex_count, scan.left() / 6));  // the shortest is "0 0 0\n"
    for (std::size_t i = 0; i < vertex_count; ++i) {
        const double x = scan.coordinate(), y = scan.coordinate(), z = scan.coordinate();
        vertices.push_back(mesh.vertex(x, y, z));
        scan.next_line();
    }
    mesh.reserve(std::min(face_count, scan.left() / 8));  // the shortest is "3 0 1 2\n"
    std::vector<int> corners;
    for (std::size_t f = 0; f < face_count; ++f) {
        corners.clear();
        for (std::size_t k = count(scan, "the number of a face's corners"); k > 0; --k) {
            const std::size_t index = count(scan, "a vertex number");
            if (index >= vertices.size())
                scan.fail("the face refers to vertex " + std::to_string(index) + ", but the file has only " +
                          std::to_string(vertices.size()));
            corners.push_back(vertices[index]);
        }
        mesh.polygon(corners);
        scan.next_line();
    }
}

}  // namespace ribvault
