#include <zip.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <memory>
#include <vector>

#include "ribvault/error.hpp"
#include "ribvault/report/wall_facets.hpp"
#include "ribvault/report/write_mesh.hpp"

namespace ribvault {
namespace {

constexpr std::string_view content_types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";

constexpr std::string_view relationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

constexpr std::string_view model_start =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources>
)";

using Corner = std::array<float, 3>;

/// The corners of one wall, each once, and its facets as numbers of them.
struct Wall {
    std::vector<Corner> corners;
    std::array<std::array<std::size_t, 3>, facets_per_wall> facets;
};

Wall read_wall(std::string_view facets) {
    Wall wall;
    for (std::size_t f = 0; f < facets_per_wall; ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            Corner corner;
            std::memcpy(corner.data(), facets.data() + f * stl_facet_bytes + (k + 1) * sizeof corner, sizeof corner);
            const auto found = std::find(wall.corners.begin(), wall.corners.end(), corner);
            wall.facets[f][k] = static_cast<std::size_t>(found - wall.corners.begin());
            if (found == wall.corners.end()) wall.corners.push_back(corner);
        }
    return wall;
}

template <class Number>
void append_attribute(std::string& xml, const char* name, Number value) {
    char digits[32];
    xml.append(name).append("=\"");
    xml.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    xml += '"';
}

std::string model_xml(std::string_view facets) {
    std::string vertices, triangles;
    std::size_t first = 0;
    for (std::size_t at = 0; at < facets.size(); at += stl_facet_bytes * facets_per_wall) {
        const Wall wall = read_wall(facets.substr(at));
        for (const Corner& c : wall.corners) {
            append_attribute(vertices, "<vertex x", c[0]);
            append_attribute(vertices, " y", c[1]);
            append_attribute(vertices, " z", c[2]);
            vertices += "/>\n";
        }
        for (const auto& f : wall.facets) {
            append_attribute(triangles, "<triangle v1", first + f[0]);
            append_attribute(triangles, " v2", first + f[1]);
            append_attribute(triangles, " v3", first + f[2]);
            triangles += "/>\n";
        }
        first += wall.corners.size();
    }
    std::string xml(model_start);
    // The format knows no empty mesh: without walls the file has no object.
    if (!facets.empty()) {
        xml += "<object id=\"1\" type=\"model\">\n<mesh>\n<vertices>\n" + vertices + "</vertices>\n<triangles>\n";
        xml += triangles + "</triangles>\n</mesh>\n</object>\n";
    }
    xml += "</resources>\n<build>\n";
    if (!facets.empty()) xml += "<item objectid=\"1\"/>\n";
    return xml + "</build>\n</model>\n";
}

[[noreturn]] void fail(const std::string& why) {
    throw Error(ErrorKind::cannot_write, "cannot make the 3MF file: " + why + "; write STL instead");
}

struct FreeSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct DiscardArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};

void add_file(zip_t* archive, const char* name, std::string_view content) {
    zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
    const zip_int64_t index = source ? zip_file_add(archive, name, source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
        zip_source_free(source);
        fail(zip_strerror(archive));
    }
    // The oldest date that the format knows instead of now: equal content gives equal bytes.
    if (zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, 1 << 5 | 1, 0) != 0)
        fail(zip_strerror(archive));
}

}  // namespace

std::string walls_3mf(std::string_view facets) {
    const std::string model = model_xml(facets);
    zip_error_t error;
    zip_error_init(&error);
    const std::unique_ptr<zip_source_t, FreeSource> memory(zip_source_buffer_create(nullptr, 0, 0, &error));
    if (!memory) fail(zip_error_strerror(&error));
    std::unique_ptr<zip_t, DiscardArchive> archive(zip_open_from_source(memory.get(), ZIP_TRUNCATE, &error));
    if (!archive) fail(zip_error_strerror(&error));
    zip_source_keep(memory.get());  // the archive frees one reference, `memory` the other

    add_file(archive.get(), "[Content_Types].xml", content_types);
    add_file(archive.get(), "_rels/.rels", relationships);
    add_file(archive.get(), "3D/3dmodel.model", model);
    if (zip_close(archive.get()) != 0) fail(zip_strerror(archive.get()));
    (void)archive.release();

    std::string bytes;
    zip_stat_t stat;
    if (zip_source_stat(memory.get(), &stat) != 0 || zip_source_open(memory.get()) != 0)
        fail(zip_error_strerror(zip_source_error(memory.get())));
    bytes.resize(stat.size);
    const zip_int64_t got = zip_source_read(memory.get(), bytes.data(), bytes.size());
    zip_source_close(memory.get());
    if (got != static_cast<zip_int64_t>(bytes.size())) fail("it could not be read back from memory");
    return bytes;
}

}  // namespace ribvault
