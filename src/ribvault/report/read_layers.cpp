#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "ribvault/error.hpp"
#include "ribvault/input_stream.hpp"
#include "ribvault/report/layers_file.hpp"

namespace ribvault {
namespace {

using Json = nlohmann::ordered_json;

/// What a line has wrong; LayersFile adds the file and the line.
struct Wrong {
    std::string what;
};

enum class Kind { number, natural, boolean, text, list, object_or_null };

struct Field {
    const char* pointer;
    Kind kind;
};

constexpr Field header_fields[] = {
    {"/program/version", Kind::text},          {"/input/path", Kind::text},
    {"/settings/layer_height_mm", Kind::number}, {"/settings/first_layer_height_mm", Kind::number},
    {"/settings/nozzle_mm", Kind::number},     {"/settings/support_radius_mm", Kind::number},
    {"/settings/straighten", Kind::boolean},   {"/settings/propagation", Kind::text},
    {"/settings/gaps", Kind::text},            {"/settings/seed", Kind::natural},
    {"/verdict/proved", Kind::boolean},        {"/verdict/layers_refuted", Kind::list},
    {"/verdict/external_overhangs", Kind::list}, {"/verdict/print/proved", Kind::boolean},
    {"/verdict/print/layers_refuted", Kind::list}, {"/totals/layers", Kind::natural},
    {"/totals/material_mm3", Kind::number},    {"/totals/shell_volume_mm3", Kind::number},
    {"/totals/support_volume_mm3", Kind::number}, {"/totals/support_length_mm", Kind::number},
    {"/totals/support_printed_length_mm", Kind::number}, {"/totals/filament_mm", Kind::number},
    {"/totals/extruded_mm3", Kind::number},
    {"/totals/print_seconds", Kind::number}};

constexpr Field layer_fields[] = {
    {"/layer", Kind::natural},                 {"/z_mm", Kind::number},
    {"/shell_volume_mm3", Kind::number},       {"/support_length_mm", Kind::number},
    {"/support_printed_length_mm", Kind::number}, {"/support_volume_mm3", Kind::number},
    {"/filament_mm", Kind::number},            {"/extruded_mm3", Kind::number},
    {"/print_seconds", Kind::number},
    {"/trees", Kind::natural},                 {"/gaps", Kind::natural},
    {"/closed_gaps", Kind::natural},           {"/patches", Kind::natural},
    {"/verdict/supported", Kind::boolean},
    {"/verdict/internal", Kind::object_or_null}, {"/verdict/external", Kind::object_or_null},
    {"/print/supported", Kind::boolean},       {"/print/unsupported_mm/1", Kind::number}};

/// Of "internal" and "external", where they are no null.
constexpr Field hole_fields[] = {{"/area_mm2/0", Kind::number},
                                 {"/area_mm2/1", Kind::number},
                                 {"/witness_mm/0", Kind::number},
                                 {"/witness_mm/1", Kind::number}};

std::string name_of(std::string pointer) {
    for (std::size_t k = 1; k < pointer.size(); ++k)
        if (pointer[k] == '/') pointer[k] = '.';
    return '"' + pointer.substr(1) + '"';
}

bool is(const Json& value, Kind kind) {
    switch (kind) {
        case Kind::number: return value.is_number();
        case Kind::natural: return value.is_number_unsigned() && value.get<std::uint64_t>() <= 2000000000;
        case Kind::boolean: return value.is_boolean();
        case Kind::text: return value.is_string();
        case Kind::list: return value.is_array();
        case Kind::object_or_null: return value.is_object() || value.is_null();
    }
    return false;
}

const char* described(Kind kind) {
    static constexpr const char* words[] = {"a number", "a whole number", "true or false",
                                            "a text",   "a list",         "an object or null"};
    return words[static_cast<std::size_t>(kind)];
}

const Json& need(const Json& object, const Field& field) {
    const Json::json_pointer pointer(field.pointer);
    if (!object.contains(pointer)) throw Wrong{"has no " + name_of(field.pointer)};
    const Json& value = object[pointer];
    if (!is(value, field.kind))
        throw Wrong{"has no valid " + name_of(field.pointer) + ": expected " + described(field.kind)};
    return value;
}

/// A field that files from before --wall-lines do not have.
void check_if_there(const Json& object, const Field& field) {
    if (object.contains(Json::json_pointer(field.pointer))) need(object, field);
}

void check_numbers(const Json& layer) {
    for (const Field& field : layer_fields) need(layer, field);
    for (const std::string hole : {"/verdict/internal", "/verdict/external"})
        for (const Field& field : hole_fields)
            if (layer[Json::json_pointer(hole)].is_object()) need(layer, {(hole + field.pointer).c_str(), field.kind});
    const char* place = "/print/place_mm";
    if (!layer.contains(Json::json_pointer(place)) || layer[Json::json_pointer(place)].is_null()) return;
    for (const char* k : {"/0", "/1"}) need(layer, {(std::string(place) + k).c_str(), Kind::number});
}

Unit lattice(const Json& value, const char* name) {
    const double mm = value.is_number() ? value.get<double>() : NAN;
    if (!(std::abs(mm) * units_per_mm < static_cast<double>(lattice_bound)))
        throw Wrong{"has no valid " + std::string("\"") + name + "\": a coordinate is no number of mm below 10 m"};
    return round_to_lattice(mm * units_per_mm);
}

const Json& list(const Json& value, const char* name, std::size_t size = 0) {
    if (!value.is_array() || (size > 0 && value.size() != size))
        throw Wrong{"has no valid \"" + std::string(name) + "\": expected " + (size > 0 ? "pairs" : "a list")};
    return value;
}

Point point(const Json& value, const char* name) {
    list(value, name, 2);
    return {lattice(value[0], name), lattice(value[1], name)};
}

Region region(const Json& layer, const char* name) {
    Region found;
    for (const Json& contour : need(layer, {(std::string("/") + name).c_str(), Kind::list})) {
        found.emplace_back();
        for (const Json& p : list(contour, name)) found.back().push_back(point(p, name));
    }
    return found;
}

/// An index into `count` vertices.
std::uint32_t index(const Json& value, std::size_t count, const char* name) {
    if (!is(value, Kind::natural) || value.get<std::uint64_t>() >= count)
        throw Wrong{"has no valid \"" + std::string(name) + "\": there is no vertex " + value.dump()};
    return value.get<std::uint32_t>();
}

LayerShapes shapes(const Json& layer) {
    LayerShapes s;
    s.slice = region(layer, "slice"), s.cavity = region(layer, "cavity"), s.unsupported = region(layer, "unsupported");
    for (const Json& p : need(layer, {"/vertices", Kind::list})) s.vertices.push_back({point(p, "vertices"), false});
    for (const Json& v : need(layer, {"/roots", Kind::list}))
        s.vertices[index(v, s.vertices.size(), "roots")].root = true;
    for (const Json& e : need(layer, {"/edges", Kind::list})) {
        list(e, "edges", 2);
        s.edges.push_back({index(e[0], s.vertices.size(), "edges"), index(e[1], s.vertices.size(), "edges")});
    }
    for (const Json& p : need(layer, {"/patch_tracks", Kind::list})) {
        list(p, "patch_tracks", 2);
        s.patches.push_back({point(p[0], "patch_tracks"), point(p[1], "patch_tracks")});
    }
    check_if_there(layer, {"/wide", Kind::list});
    if (layer.contains("wide"))
        for (const Json& v : layer["wide"]) s.vertices[index(v, s.vertices.size(), "wide")].wide = true;
    return s;
}

constexpr const char* shape_names[] = {"slice", "cavity",      "vertices",     "roots",
                                       "edges", "unsupported", "patch_tracks", "wide"};

Json parsed(const std::string& line) {
    if (line.find_first_not_of(" \t\r") == std::string::npos)
        throw Wrong{"is blank; expected a JSON object on every line"};
    Json object = Json::parse(line, nullptr, false);
    if (object.is_discarded()) throw Wrong{"is no JSON; is the file cut off?"};
    if (!object.is_object()) throw Wrong{"is no JSON object"};
    return object;
}

std::string wanted() {
    return std::string("; expected a layers file, schema ") + layers_schema +
           ", as `ribvault generate --layers` writes it";
}

void check_schema(const Json& header) {
    const Json schema = header.contains("schema") ? header["schema"] : Json();
    if (schema == layers_schema) return;
    if (!schema.is_string()) throw Wrong{"has no \"schema\"" + wanted()};
    throw Wrong{"is of schema " + schema.get<std::string>() + wanted()};
}

}  // namespace

LayersFile::LayersFile(std::filesystem::path file) : path_(std::move(file)), in_(open_input(path_, "layers")) {
    if (!read_line(header_)) fail("is empty; expected a layers file");
    try {
        if (header_ == "{" || header_ == "{\r")  // JSON over many lines
            throw Wrong{"holds no whole JSON object" + wanted()};
        const Json header = parsed(header_);
        check_schema(header);
        for (const Field& field : header_fields) need(header, field);
        check_if_there(header, {"/settings/wall_lines", Kind::natural});
        layer_count_ = header["totals"]["layers"].get<int>();
        if (layer_count_ == 0) throw Wrong{"says that there are no layers"};
    } catch (const Wrong& wrong) {
        fail(wrong.what);
    }
}

bool LayersFile::next(Layer& layer) {
    std::string line;
    const int expected = line_ - 1;
    const bool more = read_line(line);
    if (expected == layer_count_) {
        if (more) fail("is one more than the " + std::to_string(layer_count_) + " layers of the first line");
        return false;
    }
    if (!more)
        throw Error(ErrorKind::unreadable, path_.string() + " is cut off: it ends after " + std::to_string(expected) +
                                               " of " + std::to_string(layer_count_) + " layers; write it again");
    try {
        Json object = parsed(line);
        check_numbers(object);
        if (object["layer"] != expected)
            throw Wrong{"has layer " + object["layer"].dump() + " where layer " + std::to_string(expected) +
                        " should be"};
        layer.shapes = shapes(object);
        for (const char* name : shape_names) object.erase(name);
        layer.numbers = object.dump();
    } catch (const Wrong& wrong) {
        fail(wrong.what);
    }
    return true;
}

void LayersFile::fail(const std::string& what) const {
    throw Error(ErrorKind::unreadable,
                path_.string() + (line_ > 0 ? ": line " + std::to_string(line_) + " " : " ") + what);
}

bool LayersFile::read_line(std::string& line) {
    if (!std::getline(in_, line)) {
        check_read(in_, path_);
        return false;
    }
    ++line_;
    return true;
}

}  // namespace ribvault
