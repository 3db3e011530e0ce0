// PLY: ASCII and binary of either byte order; vertex x y z, face vertex_indices, everything else passed over.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "ribvault/mesh/read_formats.hpp"
#include "ribvault/mesh/text_scanner.hpp"

namespace ribvault {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(Type type) {
    static constexpr std::size_t bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

struct Property {
    std::string name;
    Type type = Type::int8;
    bool list = false;
    Type count_type = Type::int8;
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    std::string format;
    std::vector<Element> elements;
    std::size_t body = 0;  // first byte after it
};

Type parse_type(TextScanner& scan) {
    static const std::map<std::string_view, Type> types = {
        {"char", Type::int8},     {"int8", Type::int8},     {"uchar", Type::uint8},     {"uint8", Type::uint8},
        {"short", Type::int16},   {"int16", Type::int16},   {"ushort", Type::uint16},   {"uint16", Type::uint16},
        {"int", Type::int32},     {"int32", Type::int32},   {"uint", Type::uint32},     {"uint32", Type::uint32},
        {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};
    const auto type = types.find(scan.token("a number type"));
    if (type == types.end()) scan.fail("the property has no type that PLY knows");
    return type->second;
}

Property parse_property(TextScanner& scan) {
    Property property;
    TextScanner ahead = scan;
    if (ahead.token("a number type") == "list") {
        property.list = true;
        scan = ahead;
        property.count_type = parse_type(scan);
    }
    property.type = parse_type(scan);
    property.name = scan.token("a property's name");
    return property;
}

Header read_header(const InputFile& file) {
    TextScanner scan(file, 0, '\0');
    scan.next_line();
    Header header;
    for (;;) {
        const std::string_view keyword = scan.token("'end_header'");
        if (keyword == "end_header") break;
        if (keyword == "format") {
            header.format = scan.token("the format");
        } else if (keyword == "element") {
            Element element;
            element.name = scan.token("an element's name");
            const std::int64_t count = scan.integer("the number of elements");
            if (count < 0) scan.fail("a negative number of elements");
            element.count = static_cast<std::size_t>(count);
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty()) scan.fail("a property before the first element");
            header.elements.back().properties.push_back(parse_property(scan));
        } else if (keyword != "comment" && keyword != "obj_info") {
            scan.fail("the PLY header has an unknown keyword");
        }
        scan.next_line();
    }
    // A body may begin with byte 10, so that CR counts as CR LF only when the first line ended so.
    header.body = scan.position();
    while (header.body < file.data.size() && (file.data[header.body] == ' ' || file.data[header.body] == '\t'))
        ++header.body;
    header.body = std::min(header.body + (file.starts_with("ply\r\n") ? 2 : 1), file.data.size());
    return header;
}

/// Body of an ASCII file: numbers apart by blanks.
class TextBody {
public:
    TextBody(const InputFile& file, std::size_t start) : file_(file), scan_(file, start, '\0') {}
    double value(Type) { return scan_.number("a number"); }
    /// How many rows of so many values there can be at most.
    std::size_t room(std::size_t values, std::size_t) const { return scan_.left() / (2 * values); }
    std::string place() const { return "line " + std::to_string(line_number(file_, scan_.position())); }

private:
    const InputFile& file_;
    TextScanner scan_;
};

/// Body of a binary file.
class BinaryBody {
public:
    BinaryBody(const InputFile& file, std::size_t start, std::endian order)
        : file_(file), at_(start), swap_(order != std::endian::native) {}

    double value(Type type) {
        switch (type) {
            case Type::int8: return next<std::int8_t>();
            case Type::uint8: return next<std::uint8_t>();
            case Type::int16: return next<std::int16_t>();
            case Type::uint16: return next<std::uint16_t>();
            case Type::int32: return next<std::int32_t>();
            case Type::uint32: return next<std::uint32_t>();
            case Type::float32: return next<float>();
            case Type::float64: return next<double>();
        }
        return 0;
    }
    std::size_t room(std::size_t, std::size_t bytes) const { return (file_.data.size() - at_) / bytes; }
    std::string place() const { return "byte " + std::to_string(at_); }

private:
    template <class T>
    T next() {
        std::array<char, sizeof(T)> bytes;
        if (file_.data.size() - at_ < sizeof(T))
            file_.fail(ErrorKind::unreadable, "byte " + std::to_string(file_.data.size()),
                       "the file ends before all declared elements", "it is incomplete, copy or export it again");
        std::memcpy(bytes.data(), file_.data.data() + at_, sizeof(T));
        at_ += sizeof(T);
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        return std::bit_cast<T>(bytes);
    }

    const InputFile& file_;
    std::size_t at_;
    bool swap_;
};

template <class Body>
class ElementReader {
public:
    ElementReader(const InputFile& file, Body body, MeshBuilder& mesh) : file_(file), body_(body), mesh_(mesh) {}

    void read(const Element& element) {
        if (element.name == "vertex") {
            read_vertices(element);
        } else if (element.name == "face") {
            read_faces(element);
        } else if (element.name == "tristrips") {
            fail("triangle strips are not read", "save the mesh as triangles");
        } else if (!element.properties.empty()) {
            for (std::size_t i = 0; i < element.count; ++i)
                for (const Property& property : element.properties) skip(property);
        }
    }

private:
    void read_vertices(const Element& element) {
        std::array<std::size_t, 3> column;
        for (std::size_t k = 0; k < 3; ++k) {
            column[k] = find(element, {&"xyz"[k], 1});
            if (column[k] == element.properties.size() || element.properties[column[k]].list)
                fail(std::string("the vertices have no number '") + "xyz"[k] + "'", "export the mesh again");
        }
        vertices_.reserve(std::min(element.count, room(element)));
        for (std::size_t i = 0; i < element.count; ++i) {
            std::array<double, 3> p{};
            for (std::size_t k = 0; k < element.properties.size(); ++k) {
                const auto axis = std::find(column.begin(), column.end(), k) - column.begin();
                if (axis == 3) skip(element.properties[k]);
                else p[static_cast<std::size_t>(axis)] = coordinate(element.properties[k].type, i);
            }
            vertices_.push_back(mesh_.vertex(p[0], p[1], p[2]));
        }
    }

    void read_faces(const Element& element) {
        std::size_t column = find(element, "vertex_indices");
        if (column == element.properties.size()) column = find(element, "vertex_index");
        if (element.count == 0) return;
        if (column == element.properties.size() || !element.properties[column].list)
            fail("the faces have no list 'vertex_indices'", "export the mesh again");
        mesh_.reserve(std::min(element.count, room(element)));
        std::vector<int> corners;
        for (std::size_t i = 0; i < element.count; ++i) {
            for (std::size_t k = 0; k < element.properties.size(); ++k) {
                const Property& property = element.properties[k];
                if (k != column) {
                    skip(property);
                    continue;
                }
                corners.clear();
                for (std::size_t left = list_length(property); left > 0; --left)
                    corners.push_back(vertices_[index(property.type, i)]);
                mesh_.polygon(corners);
            }
        }
    }

    double coordinate(Type type, std::size_t vertex) {
        const double value = body_.value(type);
        if (!std::isfinite(value))
            file_.fail(ErrorKind::bad_geometry, body_.place() + " (vertex " + std::to_string(vertex) + ")",
                       "a coordinate is not a finite number", "repair the mesh where it was made");
        return value;
    }

    std::size_t index(Type type, std::size_t face) {
        const double value = body_.value(type);
        if (!(value >= 0 && value < static_cast<double>(vertices_.size()) && value == std::floor(value)))
            fail("face " + std::to_string(face) + " refers to vertex " + shown(value) + ", but the file has " +
                     std::to_string(vertices_.size()) + " before it",
                 "it is damaged, copy or export it again");
        return static_cast<std::size_t>(value);
    }

    std::size_t list_length(const Property& property) {
        const double value = body_.value(property.count_type);
        if (!(value >= 0 && value <= 4294967295.0 && value == std::floor(value)))
            fail("the list '" + property.name + "' has the length " + shown(value),
                 "it is damaged, copy or export it again");
        return static_cast<std::size_t>(value);
    }

    void skip(const Property& property) {
        for (std::size_t left = property.list ? list_length(property) : 1; left > 0; --left) body_.value(property.type);
    }

    std::size_t room(const Element& element) const {
        std::size_t bytes = 0;
        for (const Property& p : element.properties) bytes += size_of(p.list ? p.count_type : p.type);
        return body_.room(element.properties.size(), bytes);
    }

    static std::size_t find(const Element& element, std::string_view name) {
        const auto& all = element.properties;
        return static_cast<std::size_t>(
            std::find_if(all.begin(), all.end(), [&](const Property& p) { return p.name == name; }) - all.begin());
    }

    static std::string shown(double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.12g", value);
        return text;
    }

    [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
        file_.fail(ErrorKind::unreadable, body_.place(), what, remedy);
    }

    const InputFile& file_;
    Body body_;
    MeshBuilder& mesh_;
    std::vector<int> vertices_;
};

template <class Body>
void read_body(const InputFile& file, const Header& header, Body body, MeshBuilder& mesh) {
    ElementReader<Body> reader(file, body, mesh);
    for (const Element& element : header.elements) reader.read(element);
}

}  // namespace

void read_ply(const InputFile& file, MeshBuilder& mesh) {
    if (!file.starts_with("ply"))
        file.fail(ErrorKind::unreadable, "line 1", "a PLY file starts with 'ply', this one does not",
                  "check what the file is");
    const Header header = read_header(file);
    if (header.format == "ascii")
        read_body(file, header, TextBody(file, header.body), mesh);
    else if (header.format == "binary_little_endian")
        read_body(file, header, BinaryBody(file, header.body, std::endian::little), mesh);
    else if (header.format == "binary_big_endian")
        read_body(file, header, BinaryBody(file, header.body, std::endian::big), mesh);
    else
        file.fail(ErrorKind::unreadable, "line 2", "the PLY header names no format that is known",
                  "save it as ascii or binary_little_endian");
}

}  // namespace ribvault
