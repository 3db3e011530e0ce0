// Wavefront OBJ: v and f lines; everything else (normals, textures, groups, lines, curves) is passed over.
#include <cstdint>
#include <vector>

#include "ribvault/mesh/read_formats.hpp"
#include "ribvault/mesh/text_scanner.hpp"

namespace ribvault {
namespace {

/// Faces may refer to vertices that follow, so their corners are resolved at the end.
struct Faces {
    std::vector<std::int64_t> corners;  // from 0
    std::vector<std::size_t> ends;      // of each face in corners
    std::int64_t largest = -1;
    std::size_t largest_position = 0;
};

std::int64_t parse_corner(const TextScanner& scan, std::string_view token, std::int64_t vertices) {
    const auto index = parse_integer(token.substr(0, token.find('/')));
    if (!index || *index == 0) scan.fail("'f' needs vertex numbers from 1 on, or negative ones");
    if (*index < -vertices)
        scan.fail("the face refers to vertex " + std::to_string(*index) + ", but only " + std::to_string(vertices) +
                  " precede it");
    return *index > 0 ? *index - 1 : vertices + *index;
}

void parse_face(TextScanner& scan, std::int64_t vertices, Faces& faces) {
    while (!scan.at_line_end()) {
        const std::string_view token = scan.token("a corner");
        if (token == "\\") {
            scan.next_line();
            continue;
        }
        faces.corners.push_back(parse_corner(scan, token, vertices));
        if (faces.corners.back() > faces.largest) {
            faces.largest = faces.corners.back();
            faces.largest_position = scan.position();
        }
    }
    faces.ends.push_back(faces.corners.size());
}

}  // namespace

void read_obj(const InputFile& file, MeshBuilder& mesh) {
    TextScanner scan(file, file.starts_with("\xef\xbb\xbf") ? 3 : 0, '#');
    std::vector<int> vertices;
    Faces faces;
    while (!scan.at_end()) {
        const std::string_view keyword = scan.token("a keyword");
        if (keyword == "v") {
            double p[3];
            for (double& coordinate : p) {
                if (scan.at_line_end()) scan.fail("'v' needs three coordinates");
                coordinate = scan.coordinate();
            }
            vertices.push_back(mesh.vertex(p[0], p[1], p[2]));
        } else if (keyword == "f") {
            parse_face(scan, std::ssize(vertices), faces);
        }
        scan.next_line();
    }
    if (faces.largest >= std::ssize(vertices))
        file.fail(ErrorKind::unreadable, "line " + std::to_string(line_number(file, faces.largest_position)),
                  "the face refers to vertex " + std::to_string(faces.largest + 1) + ", but the file has only " +
                      std::to_string(vertices.size()),
                  "it is incomplete or damaged, copy or export it again");
    std::vector<int> corners;
    std::size_t begin = 0;
    for (const std::size_t end : faces.ends) {
        corners.clear();
        for (; begin != end; ++begin) corners.push_back(vertices[static_cast<std::size_t>(faces.corners[begin])]);
        mesh.polygon(corners);
    }
}

}  // namespace ribvault
