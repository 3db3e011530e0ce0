#include "ribvault/report/layer_shapes.hpp"

#include "ribvault/print/gcode_text.hpp"
#include "ribvault/report/packed.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

constexpr Unit units_per_um = units_per_mm / 1000;

Point to_micrometre(Point p) {
    const auto rounded = [](Unit u) {
        return (u + (u < 0 ? -units_per_um : units_per_um) / 2) / units_per_um * units_per_um;
    };
    return {rounded(p.x), rounded(p.y)};
}

Region to_micrometre(const Region& region) {
    Region rounded = region;
    for (Contour& contour : rounded)
        for (Point& p : contour) p = to_micrometre(p);
    return rounded;
}

void append_point(std::string& text, Point p) {
    text += '[';
    append_decimal(text, p.x);
    text += ',';
    append_decimal(text, p.y);
    text += ']';
}

template <class List, class Append>
void append_list(std::string& text, const List& list, Append append) {
    text += '[';
    bool first = true;
    for (const auto& entry : list) {
        if (!first) text += ',';
        first = false;
        append(text, entry);
    }
    text += ']';
}

void append_region(std::string& text, const Region& region) {
    append_list(text, region, [](std::string& t, const Contour& contour) { append_list(t, contour, append_point); });
}

/// The vertices that are marked so, ascending.
std::vector<std::uint32_t> marked(const LayerShapes& shapes, bool SupportVertex::*mark) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t v = 0; v < shapes.vertices.size(); ++v)
        if (shapes.vertices[v].*mark) found.push_back(v);
    return found;
}

void append_indices(std::string& text, const std::vector<std::uint32_t>& indices) {
    append_list(text, indices, [](std::string& t, std::uint32_t v) { t += std::to_string(v); });
}

void pack_indices(Packed& out, const std::vector<std::uint32_t>& indices) {
    out.natural(indices.size());
    std::int64_t before = 0;
    for (const std::int64_t v : indices) out.whole(v - before), before = v;
}

}  // namespace

LayerShapes shapes_of(const Slice& slice, const Region& cavity, const SupportForest& forest, const Region& unsupported,
                      const std::vector<Segment>& patches) {
    const Region once = unsupported.empty() ? Region() : clip(ClipperLib::ctUnion, unsupported, {});
    LayerShapes shapes{to_micrometre(slice.rounded), to_micrometre(cavity), {}, {}, to_micrometre(once), patches};
    for (Segment& s : shapes.patches) s = {to_micrometre(s.a), to_micrometre(s.b)};
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        const SupportVertex& s = forest[*v];
        shapes.vertices.push_back({.at = to_micrometre(s.at), .root = s.root, .wide = s.wide});
    }
    for (auto [e, end] = edges(forest); e != end; ++e)
        shapes.edges.push_back(
            {static_cast<std::uint32_t>(source(*e, forest)), static_cast<std::uint32_t>(target(*e, forest))});
    return shapes;
}

std::string shapes_json(const LayerShapes& shapes) {
    std::string text = "\"slice\":";
    append_region(text, shapes.slice);
    text += ",\"cavity\":";
    append_region(text, shapes.cavity);
    text += ",\"vertices\":";
    append_list(text, shapes.vertices, [](std::string& t, const SupportVertex& v) { append_point(t, v.at); });
    text += ",\"roots\":";
    append_indices(text, marked(shapes, &SupportVertex::root));
    text += ",\"edges\":";
    append_list(text, shapes.edges, [](std::string& t, const std::array<std::uint32_t, 2>& e) {
        t += '[' + std::to_string(e[0]) + ',' + std::to_string(e[1]) + ']';
    });
    text += ",\"unsupported\":";
    append_region(text, shapes.unsupported);
    text += ",\"patch_tracks\":";
    append_list(text, shapes.patches, [](std::string& t, const Segment& s) {
        t += '[';
        append_point(t, s.a);
        t += ',';
        append_point(t, s.b);
        t += ']';
    });
    if (const std::vector<std::uint32_t> wide = marked(shapes, &SupportVertex::wide); !wide.empty()) {
        text += ",\"wide\":";
        append_indices(text, wide);
    }
    return text;
}

std::string packed_shapes(const LayerShapes& shapes) {
    Packed out;
    out.region(shapes.slice);
    out.region(shapes.cavity);
    out.natural(shapes.vertices.size());
    for (const SupportVertex& v : shapes.vertices) out.point(v.at);
    pack_indices(out, marked(shapes, &SupportVertex::root));
    out.natural(shapes.edges.size());
    std::int64_t before = 0;
    for (const auto& [a, b] : shapes.edges) {
        out.whole(a - before), out.whole(static_cast<std::int64_t>(b) - a);
        before = a;
    }
    out.region(shapes.unsupported);
    out.natural(shapes.patches.size());
    for (const Segment& s : shapes.patches) out.point(s.a), out.point(s.b);
    if (const std::vector<std::uint32_t> wide = marked(shapes, &SupportVertex::wide); !wide.empty())
        pack_indices(out, wide);
    return out.bytes();
}

}  // namespace ribvault
