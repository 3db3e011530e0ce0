// 3MF: a ZIP archive of XML (3MF Core Specification 1.3, Production Extension 1.1 for objects in other parts).
#include <zip.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "ribvault/mesh/read_formats.hpp"
#include "ribvault/mesh/text_scanner.hpp"

namespace ribvault {
namespace {

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

/// Limits that no real file meets; they stop archives and nested components that unfold without end.
constexpr std::size_t most_part_bytes = std::size_t{1} << 32, most_triangles = 100000000, most_components = 1000000;
constexpr int deepest_nesting = 100;

std::string_view local_name(std::string_view name) {
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
    return node.find_child([&](const pugi::xml_node& n) { return local_name(n.name()) == name; });
}

pugi::xml_attribute attribute(const pugi::xml_node& node, std::string_view name) {
    return node.find_attribute([&](const pugi::xml_attribute& a) { return local_name(a.name()) == name; });
}

class Package {
public:
    Package(const InputFile& file, MeshBuilder& mesh) : file_(file), mesh_(mesh), archive_(open(file)) {}

    void read() {
        const std::string root = model_part();
        const Part& model = part(root);
        const pugi::xml_node build = child(model.root, "build");
        if (!build) fail(root, "the model has no <build>", "export the mesh again");
        int items = 0, switched_off = 0;
        for (const pugi::xml_node& item : build.children()) {
            if (local_name(item.name()) != "item") continue;
            ++items;
            const std::string_view printable = attribute(item, "printable").value();  // PrusaSlicer's
            if (printable == "0" || printable == "false")
                ++switched_off;
            else
                place(root, item, Eigen::Affine3d::Identity(), 0);
        }
        if (items == 0)
            file_.fail(ErrorKind::bad_geometry, root, "the <build> has no <item>: nothing is to be printed",
                       "put an object on the plate and export again");
        if (items == switched_off)
            file_.fail(ErrorKind::bad_geometry, root, "all items of the <build> are marked as not printable",
                       "mark one as printable and export again");
    }

private:
    /// A document that lies in its own text.
    struct Xml {
        std::string text;
        pugi::xml_document document;
    };
    struct Part {
        std::unique_ptr<Xml> xml;
        pugi::xml_node root;
        double mm_per_unit = 1;
        std::map<std::string, pugi::xml_node, std::less<>> objects;  // by id
    };

    static Archive open(const InputFile& file) {
        zip_error_t error;
        zip_error_init(&error);
        zip_source_t* source = zip_source_buffer_create(file.data.data(), file.data.size(), 0, &error);
        zip_t* archive = source ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
        const std::string reason = zip_error_strerror(&error);
        zip_error_fini(&error);
        if (!archive) {
            if (source) zip_source_free(source);
            file.fail(ErrorKind::unreadable, "", "the ZIP archive of the 3MF file cannot be opened (" + reason + ")",
                      "it is incomplete or damaged, copy or export it again");
        }
        return Archive(archive, &zip_discard);
    }

    bool has(const std::string& name) const {
        return zip_name_locate(archive_.get(), name.c_str(), ZIP_FL_NOCASE) >= 0;
    }

    std::string content(const std::string& name) const {
        const zip_int64_t index = zip_name_locate(archive_.get(), name.c_str(), ZIP_FL_NOCASE);
        if (index < 0) fail(name, "the archive has no such part", "it is no 3MF file or damaged, export it again");
        const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> part(
            zip_fopen_index(archive_.get(), static_cast<zip_uint64_t>(index), 0), &zip_fclose);
        if (!part)
            fail(name, std::string("the part cannot be opened (") + zip_strerror(archive_.get()) + ")",
                 "export it again without a password");
        std::string text;
        zip_stat_t facts;
        if (zip_stat_index(archive_.get(), static_cast<zip_uint64_t>(index), 0, &facts) == 0 &&
            (facts.valid & ZIP_STAT_SIZE) != 0)
            text.reserve(std::min<zip_uint64_t>(facts.size, 1 << 30));  // the archive may say anything
        std::vector<char> block(1 << 20);
        zip_int64_t got;
        while ((got = zip_fread(part.get(), block.data(), block.size())) > 0) {
            text.append(block.data(), static_cast<std::size_t>(got));
            if (text.size() > most_part_bytes) fail(name, "the part unpacks to more than 4 GB", "simplify the mesh");
        }
        if (got < 0) fail(name, "the part cannot be unpacked", "the file is damaged, copy or export it again");
        return text;
    }

    std::unique_ptr<Xml> xml(const std::string& name) const {
        auto xml = std::make_unique<Xml>();
        xml->text = content(name);
        const pugi::xml_parse_result result = xml->document.load_buffer_inplace(xml->text.data(), xml->text.size());
        if (!result)
            fail(name + ", byte " + std::to_string(result.offset),
                 std::string("the XML is broken (") + result.description() + ")", "export the mesh again");
        return xml;
    }

    /// Name of the part where the build is: what the package's relations call the 3D model.
    std::string model_part() const {
        if (has("_rels/.rels")) {
            const auto relations = xml("_rels/.rels");
            for (const pugi::xml_node& relation : relations->document.document_element().children())
                if (std::string_view(attribute(relation, "Type").value()).ends_with("/3dmodel"))
                    return plain(attribute(relation, "Target").value());
        }
        return "3D/3dmodel.model";
    }

    static std::string plain(std::string_view path) {
        return std::string(path.starts_with('/') ? path.substr(1) : path);
    }

    const Part& part(const std::string& name) {
        const auto known = parts_.find(name);
        if (known != parts_.end()) return known->second;
        Part part;
        part.xml = xml(name);
        part.root = part.xml->document.document_element();
        if (local_name(part.root.name()) != "model") fail(name, "the part is no 3MF <model>", "export the mesh again");
        refuse_extensions(name, part.root);
        static const std::map<std::string_view, double> units = {{"micron", 0.001},  {"millimeter", 1},
                                                                 {"centimeter", 10}, {"inch", 25.4},
                                                                 {"foot", 304.8},    {"meter", 1000}};
        const pugi::xml_attribute unit = attribute(part.root, "unit");
        const auto scale = units.find(unit ? unit.value() : "millimeter");
        if (scale == units.end())
            fail(name, std::string("the unit '") + unit.value() + "' is not one of 3MF's",
                 "export the mesh in millimetres");
        part.mm_per_unit = scale->second;
        for (const pugi::xml_node& object : child(part.root, "resources").children())
            if (local_name(object.name()) == "object") part.objects.emplace(attribute(object, "id").value(), object);
        return parts_.emplace(name, std::move(part)).first->second;
    }

    /// What the part says that a reader must understand (Core Specification, 2.3.3): prefixes of namespaces.
    void refuse_extensions(const std::string& name, const pugi::xml_node& model) const {
        static constexpr std::string_view understood[] = {
            "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
            "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
            "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",  // colours, which change no shape
            "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"};
        std::istringstream prefixes(attribute(model, "requiredextensions").value());
        for (std::string prefix; prefixes >> prefix;) {
            const std::string_view space = model.attribute(("xmlns:" + prefix).c_str()).value();
            if (std::find(std::begin(understood), std::end(understood), space) == std::end(understood))
                fail(name, "it needs the 3MF extension '" + (space.empty() ? prefix : std::string(space)) + "'",
                     "export the objects as plain meshes");
        }
    }

    /// Adds the object that an <item> or <component> refers to, `outer` applied after the reference's own transform.
    void place(const std::string& in_part, const pugi::xml_node& reference, const Eigen::Affine3d& outer, int depth) {
        const pugi::xml_attribute path = attribute(reference, "path");
        const std::string name = path ? plain(path.value()) : in_part;
        const std::string id = attribute(reference, "objectid").value();
        if (depth > deepest_nesting || ++components_ > most_components)
            fail(name, "the components are nested without end (at object " + id + ")", "export the mesh again");
        const Part& from = part(name);
        const auto object = from.objects.find(id);
        if (object == from.objects.end())
            fail(name, "object '" + id + "' is used but not there", "the file is damaged, export it again");
        const std::string_view type = attribute(object->second, "type").value();
        if (type == "support" || type == "solidsupport" || type == "surface" || type == "other") return;
        const Eigen::Affine3d whole = outer * transform(name, attribute(reference, "transform").value());
        if (const pugi::xml_node mesh = child(object->second, "mesh"))
            return add(name, id, mesh, whole, from.mm_per_unit);
        const pugi::xml_node components = child(object->second, "components");
        if (!components)
            fail(name, "object '" + id + "' is neither a mesh nor made of components", "export it as a plain mesh");
        for (const pugi::xml_node& component : components.children())
            if (local_name(component.name()) == "component") place(name, component, whole, depth + 1);
    }

    /// Twelve numbers, rows of a matrix that row vectors are multiplied by (Core Specification, 3.3).
    Eigen::Affine3d transform(const std::string& name, std::string_view text) const {
        Eigen::Affine3d result = Eigen::Affine3d::Identity();
        if (text.empty()) return result;
        for (int k = 0; k < 12; ++k) {
            text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
            const std::size_t end = std::min(text.find_first_of(" \t\r\n"), text.size());
            const auto value = parse_double(text.substr(0, end));
            if (!value || !std::isfinite(*value))
                fail(name, "a transform is not twelve numbers", "export the mesh again");
            result(k % 3, k / 3) = *value;
            text.remove_prefix(end);
        }
        if (text.find_first_not_of(" \t\r\n") != std::string_view::npos)
            fail(name, "a transform is more than twelve numbers", "export the mesh again");
        return result;
    }

    void add(const std::string& name, const std::string& id, const pugi::xml_node& mesh,
             const Eigen::Affine3d& transform, double mm_per_unit) {
        const bool as_read = transform.matrix().isIdentity(0) && mm_per_unit == 1;
        const bool mirrored = transform.linear().determinant() < 0;
        std::vector<int> vertices;
        for (const pugi::xml_node& vertex : child(mesh, "vertices").children()) {
            if (local_name(vertex.name()) != "vertex") continue;
            const auto value = [&](const char* axis) {
                const auto number = parse_double(vertex.attribute(axis).value());
                if (number && std::isfinite(*number)) return *number;
                file_.fail(number ? ErrorKind::bad_geometry : ErrorKind::unreadable,
                           name + ", object " + id + ", vertex " + std::to_string(vertices.size()),
                           std::string(axis) + (number ? " is not a finite number" : " is not a number"),
                           "repair the mesh where it was made");
            };
            Eigen::Vector3d p(value("x"), value("y"), value("z"));
            if (!as_read) p = (transform * p) * mm_per_unit;
            vertices.push_back(mesh_.vertex(p[0], p[1], p[2]));
        }
        std::size_t number = 0;
        for (const pugi::xml_node& triangle : child(mesh, "triangles").children()) {
            if (local_name(triangle.name()) != "triangle") continue;
            std::array<int, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) {
                static constexpr const char* names[] = {"v1", "v2", "v3"};
                const std::string_view text = triangle.attribute(names[k]).value();
                const auto index = parse_integer(text);
                if (!index || *index < 0 || *index >= std::ssize(vertices))
                    fail(name + ", object " + id + ", triangle " + std::to_string(number),
                         "it refers to vertex '" + std::string(text) + "', but the object has " +
                             std::to_string(vertices.size()),
                         "the file is damaged, export it again");
                corner[k] = vertices[static_cast<std::size_t>(*index)];
            }
            ++number;
            if (mirrored) std::swap(corner[1], corner[2]);
            mesh_.triangle(corner[0], corner[1], corner[2]);
            if (mesh_.triangles() > most_triangles)
                fail(name, "the build has more than 100 million triangles", "print fewer copies");
        }
    }

    [[noreturn]] void fail(const std::string& place, const std::string& what, const std::string& remedy) const {
        file_.fail(ErrorKind::unreadable, place, what, remedy);
    }

    const InputFile& file_;
    MeshBuilder& mesh_;
    Archive archive_;
    std::map<std::string, Part> parts_;
    std::size_t components_ = 0;
};

}  // namespace

void read_3mf(const InputFile& file, MeshBuilder& mesh) { Package(file, mesh).read(); }

}  // namespace ribvault
