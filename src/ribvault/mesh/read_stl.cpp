// STL, binary and ASCII.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "ribvault/mesh/read_formats.hpp"
#include "ribvault/mesh/text_scanner.hpp"

namespace ribvault {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::uint32_t little_endian_32(const char* bytes) {
    std::uint32_t value;
    std::memcpy(&value, bytes, 4);
    if constexpr (std::endian::native == std::endian::big) value = __builtin_bswap32(value);
    return value;
}

bool same_word(std::string_view token, std::string_view lower_case) {
    return std::equal(token.begin(), token.end(), lower_case.begin(), lower_case.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

void read_binary(const InputFile& file, MeshBuilder& mesh) {
    const std::size_t count = little_endian_32(&file.data[80]);
    mesh.reserve(count);
    const char* at = &file.data[header_bytes];
    for (std::size_t t = 0; t < count; ++t, at += triangle_bytes) {
        std::array<int, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<float, 3> p;
            for (std::size_t i = 0; i < 3; ++i) {
                p[i] = std::bit_cast<float>(little_endian_32(at + 12 + 12 * k + 4 * i));
                if (!std::isfinite(p[i]))
                    file.fail(ErrorKind::bad_geometry,
                              "triangle " + std::to_string(t) + " (byte " + std::to_string(at - file.data.data()) + ")",
                              "a coordinate is not a finite number", "repair the mesh where it was made");
            }
            corner[k] = mesh.vertex(p[0], p[1], p[2]);
        }
        mesh.triangle(corner[0], corner[1], corner[2]);
    }
}

void read_facet(TextScanner& scan, MeshBuilder& mesh) {
    for (int skipped = 0;; ++skipped) {  // "normal" and three numbers, whatever they are
        const std::string_view word = scan.token("'outer loop'");
        if (same_word(word, "outer")) break;
        if (skipped == 4 || same_word(word, "vertex") || same_word(word, "endfacet"))
            scan.fail("a facet without 'outer loop'");
    }
    if (!same_word(scan.token("'loop'"), "loop")) scan.fail("'outer' without 'loop'");
    std::array<int, 3> corner;
    for (int& c : corner) {
        if (!same_word(scan.token("'vertex'"), "vertex")) scan.fail("a facet without three lines 'vertex x y z'");
        const double x = scan.coordinate(), y = scan.coordinate(), z = scan.coordinate();
        c = mesh.vertex(x, y, z);
    }
    if (!same_word(scan.token("'endloop'"), "endloop")) scan.fail("a facet with more than three corners");
    if (!same_word(scan.token("'endfacet'"), "endfacet")) scan.fail("'endloop' without 'endfacet'");
    mesh.triangle(corner[0], corner[1], corner[2]);
}

void read_ascii(const InputFile& file, std::size_t start, MeshBuilder& mesh) {
    TextScanner scan(file, start, '\0');
    while (!scan.at_end()) {
        if (!same_word(scan.token("'solid'"), "solid")) scan.fail("text outside of 'solid' ... 'endsolid'");
        scan.next_line();
        for (;;) {
            const std::string_view word = scan.token("'facet' or 'endsolid'");
            if (same_word(word, "endsolid")) break;
            if (!same_word(word, "facet")) scan.fail("neither 'facet' nor 'endsolid'");
            read_facet(scan, mesh);
        }
        scan.next_line();
    }
}

/// "solid" first, and no NUL anywhere near: binary headers that say "solid" are padded or followed by small counts.
bool looks_ascii(const InputFile& file, std::size_t start) {
    const std::string_view head = std::string_view(file.data).substr(start, 1000);
    return head.size() >= 5 && same_word(head.substr(0, 5), "solid") && head.find('\0') == std::string_view::npos;
}

}  // namespace

bool is_binary_stl(const InputFile& file) {
    return file.data.size() >= header_bytes &&
           file.data.size() == header_bytes + triangle_bytes * std::size_t{little_endian_32(&file.data[80])};
}

void read_stl(const InputFile& file, MeshBuilder& mesh) {
    if (is_binary_stl(file)) return read_binary(file, mesh);
    const std::size_t start = std::min(file.data.find_first_not_of(" \t\r\n\xef\xbb\xbf"), file.data.size());
    if (looks_ascii(file, start)) return read_ascii(file, start, mesh);
    const std::string_view head = std::string_view(file.data).substr(0, 1000);
    if (std::all_of(head.begin(), head.end(), [](unsigned char c) { return c >= ' ' || std::isspace(c); }))
        file.fail(ErrorKind::unreadable, "line 1", "an STL text starts with 'solid', this one does not",
                  "check what the file is");
    if (file.data.size() < header_bytes)
        file.fail(ErrorKind::unreadable, "byte " + std::to_string(file.data.size()),
                  "the file ends inside the 84 bytes of a binary STL header",
                  "it is incomplete, copy or export it again");
    const std::size_t declared = little_endian_32(&file.data[80]),
                      needed = header_bytes + triangle_bytes * declared;
    if (file.data.size() > needed && file.data.size() < needed + triangle_bytes)
        file.fail(ErrorKind::unreadable, "byte " + std::to_string(needed),
                  "there are " + std::to_string(file.data.size() - needed) + " bytes after the " +
                      std::to_string(declared) + " triangles that the binary STL header declares",
                  "it is damaged, copy or export it again");
    file.fail(ErrorKind::unreadable, "byte 80",
              "a binary STL header declares " + std::to_string(declared) +
                  " triangles, but the file's " + std::to_string(file.data.size()) + " bytes hold " +
                  std::to_string((file.data.size() - header_bytes) / triangle_bytes),
              "it is incomplete or damaged, copy or export it again");
}

}  // namespace ribvault
