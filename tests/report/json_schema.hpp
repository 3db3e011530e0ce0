// What a JSON text has wrong by one of the schemas in docs.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/scratch_folder.hpp"

namespace ribvault::test {

using Json = nlohmann::json;

/// A page of docs.
inline std::string page(const std::string& name) {
    return contents((std::filesystem::path(RIBVAULT_CORPUS) / "../../docs" / name).lexically_normal());
}

inline Json read_schema(const std::string& name) { return Json::parse(page(name)); }

inline bool has_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    return type == "null" && value.is_null();
}

/// Every way in which `value` does not follow `schema`, a part of `root`; the keywords are those that the schema files
/// use. Members are unknown unless additionalProperties allows them.
inline void violations(const Json& schema, const Json& value, const Json& root, const std::string& at,
                std::vector<std::string>& found) {
    if (schema.contains("$ref")) {
        const std::string target = schema["$ref"];
        const std::size_t hash = target.find('#');
        const Json other = hash > 0 ? read_schema(target.substr(0, hash)) : Json();
        const Json& document = hash > 0 ? other : root;
        return violations(document.at(Json::json_pointer(target.substr(hash + 1))), value, document, at, found);
    }
    if (schema.contains("anyOf")) {
        for (const Json& option : schema["anyOf"]) {
            std::vector<std::string> here;
            violations(option, value, root, at, here);
            if (here.empty()) return;
        }
        found.push_back(at + ": no alternative fits");
        return;
    }
    if (schema.contains("const") && value != schema["const"]) found.push_back(at + ": not the constant");
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
        found.push_back(at + ": " + value.dump() + " is none of the values");
    if (schema.contains("type")) {
        const Json& type = schema["type"];
        bool fits = type.is_string() && has_type(value, type.get<std::string>());
        if (type.is_array())
            for (const Json& t : type) fits = fits || has_type(value, t.get<std::string>());
        if (!fits) found.push_back(at + ": is " + value.dump() + ", not of type " + type.dump());
    }
    if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
        found.push_back(at + ": too small");
    if (value.is_array() && schema.contains("minItems") && value.size() < schema["minItems"])
        found.push_back(at + ": too short");
    if (value.is_array() && schema.contains("maxItems") && value.size() > schema["maxItems"])
        found.push_back(at + ": too long");
    if (value.is_array() && schema.contains("items"))
        for (std::size_t i = 0; i < value.size(); ++i)
            violations(schema["items"], value[i], root, at + "/" + std::to_string(i), found);
    if (!value.is_object()) return;
    for (const Json& name : schema.value("required", Json::array()))
        if (!value.contains(name)) found.push_back(at + ": no " + name.dump());
    for (const auto& [name, member] : value.items()) {
        if (schema.contains("properties") && schema["properties"].contains(name))
            violations(schema["properties"][name], member, root, at + "/" + name, found);
        else if (schema.value("additionalProperties", Json(true)).is_object())
            violations(schema["additionalProperties"], member, root, at + "/" + name, found);
        else if (schema.value("additionalProperties", Json(true)) != Json(true) ||
                 !schema.contains("additionalProperties"))
            found.push_back(at + ": unknown member " + name);
    }
}

/// Every way in which `value` does not follow the schema file.
inline std::vector<std::string> violations(const Json& value, const std::string& schema_file) {
    const Json schema = read_schema(schema_file);
    std::vector<std::string> found;
    violations(schema, value, schema, "", found);
    return found;
}

}  // namespace ribvault::test
