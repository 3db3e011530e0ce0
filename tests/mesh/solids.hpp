// Small solids and the same mesh in every file format, for the tests of this stage.
#pragma once

#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ribvault/mesh/mesh.hpp"
#include "ribvault/mesh/mesh_builder.hpp"

namespace ribvault::test {

using Corner = std::array<double, 3>;
using Triangle = std::array<Corner, 3>;

/// A folder that disappears with the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "ribvault-mesh-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        std::filesystem::remove(path_ / name);  // overwriting would make some file systems flush to disk
        std::ofstream(path_ / name, std::ios::binary) << content;
        return path_ / name;
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Box with outward triangles, or inward ones when `inverted`.
inline std::vector<Triangle> box(Corner lo, Corner hi, bool inverted = false) {
    const auto corner = [&](int bits) {
        return Corner{bits & 1 ? hi[0] : lo[0], bits & 2 ? hi[1] : lo[1], bits & 4 ? hi[2] : lo[2]};
    };
    static constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::vector<Triangle> triangles;
    for (const auto& q : quads)
        for (int k = 2; k < 4; ++k) {
            Triangle t{corner(q[0]), corner(q[k - 1]), corner(q[k])};
            if (inverted) std::swap(t[1], t[2]);
            triangles.push_back(t);
        }
    return triangles;
}

inline std::vector<Triangle> operator+(std::vector<Triangle> a, const std::vector<Triangle>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

inline Mesh weld(const std::vector<Triangle>& triangles) {
    MeshBuilder builder;
    for (const Triangle& t : triangles) {
        int corner[3];
        for (int k = 0; k < 3; ++k) corner[k] = builder.vertex(t[k][0], t[k][1], t[k][2]);
        builder.triangle(corner[0], corner[1], corner[2]);
    }
    return builder.finish();
}

/// The triangles as coordinates, each starting at its smallest corner: equal for equal meshes in any order.
inline std::multiset<Triangle> coordinates(const Mesh& mesh) {
    std::multiset<Triangle> result;
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        Triangle triangle;
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i) triangle[k][i] = mesh.vertices(i, mesh.triangles(k, t));
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        result.insert(triangle);
    }
    return result;
}

template <class T>
std::string bytes(T value, std::endian order = std::endian::little) {
    auto array = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (order != std::endian::native) std::reverse(array.begin(), array.end());
    return {array.data(), array.size()};
}

inline std::string shortest(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

inline std::string binary_stl(const std::vector<Triangle>& triangles, std::string header = "binary") {
    header.resize(80, ' ');
    std::string text = header + bytes(static_cast<std::uint32_t>(triangles.size()));
    for (const Triangle& t : triangles) {
        text += std::string(12, '\0');
        for (const Corner& c : t)
            for (double x : c) text += bytes(static_cast<float>(x));
        text += std::string(2, '\0');
    }
    return text;
}

inline std::string ascii_stl(const std::vector<Triangle>& triangles, const std::string& newline = "\n") {
    std::string text = "solid facet of the art" + newline;
    for (const Triangle& t : triangles) {
        text += "facet normal nan 0 0" + newline + "outer loop" + newline;
        for (const Corner& c : t)
            text += "  vertex " + shortest(c[0]) + " " + shortest(c[1]) + " " + shortest(c[2]) + newline;
        text += "endloop" + newline + "endfacet" + newline;
    }
    return text + "endsolid" + newline;
}

inline std::string off(const Mesh& mesh, const std::string& keyword = "OFF", const std::string& after_vertex = "") {
    std::string text = "# a comment\n" + keyword + "\n" + std::to_string(mesh.vertices.cols()) + " " +
                       std::to_string(mesh.triangles.cols()) + " 0 # and another\n\n";
    for (int v = 0; v < mesh.vertices.cols(); ++v)
        text += shortest(mesh.vertices(0, v)) + " " + shortest(mesh.vertices(1, v)) + "\t" +
                shortest(mesh.vertices(2, v)) + after_vertex + "\n";
    for (int t = 0; t < mesh.triangles.cols(); ++t)
        text += "3 " + std::to_string(mesh.triangles(0, t)) + " " + std::to_string(mesh.triangles(1, t)) + " " +
                std::to_string(mesh.triangles(2, t)) + " 255 0 0\n";
    return text;
}

inline std::string obj(const Mesh& mesh, bool negative = false) {
    std::string text = "# cube\nmtllib none.mtl\no cube\n";
    const auto count = static_cast<int>(mesh.vertices.cols());
    for (int v = 0; v < count; ++v)
        text += "v " + shortest(mesh.vertices(0, v)) + " " + shortest(mesh.vertices(1, v)) + " " +
                shortest(mesh.vertices(2, v)) + " 0.5 0.5 0.5\nvn 0 0 1\n";
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        text += "f";
        for (int k = 0; k < 3; ++k) {
            const int index = mesh.triangles(k, t);
            text += " " + std::to_string(negative ? index - count : index + 1) +
                    (negative ? "//1" : k == 1 ? "/1/1" : "");
        }
        text += "\n";
    }
    return text;
}

/// With a colour before and a list after the coordinates, an element of another kind, and a property after the corners.
inline std::string ply(const Mesh& mesh, const std::string& format) {
    std::string text = "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
                       std::to_string(mesh.vertices.cols()) +
                       "\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\n"
                       "property list short float extras\nelement edge 1\nproperty int vertex1\nelement face " +
                       std::to_string(mesh.triangles.cols()) +
                       "\nproperty list uint8 uint vertex_index\nproperty ushort flags\nend_header\n";
    const std::endian order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    const auto put = [&](auto value) {
        text += format == "ascii" ? shortest(static_cast<double>(value)) + " " : bytes(value, order);
    };
    const auto end_row = [&] { text += format == "ascii" ? "\n" : ""; };
    for (int v = 0; v < mesh.vertices.cols(); ++v) {
        put(std::uint8_t{200});
        for (int i = 0; i < 3; ++i) put(mesh.vertices(i, v));
        put(std::int16_t{2}), put(1.5f), put(2.5f), end_row();
    }
    put(std::int32_t{7}), end_row();
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        put(std::uint8_t{3});
        for (int k = 0; k < 3; ++k) put(static_cast<std::uint32_t>(mesh.triangles(k, t)));
        put(std::uint16_t{1}), end_row();
    }
    return text;
}

/// <mesh> element of 3MF.
inline std::string mesh_xml(const Mesh& mesh) {
    std::string text = "<mesh><vertices>";
    for (int v = 0; v < mesh.vertices.cols(); ++v)
        text += "<vertex x=\"" + shortest(mesh.vertices(0, v)) + "\" y=\"" + shortest(mesh.vertices(1, v)) + "\" z=\"" +
                shortest(mesh.vertices(2, v)) + "\"/>";
    text += "</vertices><triangles>";
    for (int t = 0; t < mesh.triangles.cols(); ++t)
        text += "<triangle v1=\"" + std::to_string(mesh.triangles(0, t)) + "\" v2=\"" +
                std::to_string(mesh.triangles(1, t)) + "\" v3=\"" + std::to_string(mesh.triangles(2, t)) + "\"/>";
    return text + "</triangles></mesh>";
}

inline std::string model_xml(const std::string& resources, const std::string& build,
                             const std::string& unit = "millimeter") {
    return "<?xml version=\"1.0\"?><model unit=\"" + unit +
           "\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
           "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"><resources>" +
           resources + "</resources><build>" + build + "</build></model>";
}

inline void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& parts) {
    int error = 0;
    zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
    REQUIRE(archive != nullptr);
    for (const auto& [name, text] : parts)
        REQUIRE(zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0), 0) >= 0);
    REQUIRE(zip_close(archive) == 0);
}

inline std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace ribvault::test
