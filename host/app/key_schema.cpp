#include "host/app/key_schema.h"

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "host/model/case_keys.h"

namespace vkdose {
namespace {

using Json = nlohmann::ordered_json;

/// Adds the kind of a value, and the values that are allowed.
void addKind(Json& schema, const Key& key) {
    switch (key.type) {
        case Key::Type::Number:
            schema["type"] = "number";
            if (key.bound == Bound::Positive) schema["exclusiveMinimum"] = 0;
            if (key.bound == Bound::NonNegative) schema["minimum"] = 0;
            break;
        case Key::Type::Integer:
            schema["type"] = "integer";
            schema["minimum"] = key.low;
            if (key.high != std::numeric_limits<std::int64_t>::max()) schema["maximum"] = key.high;
            break;
        case Key::Type::Boolean:
            schema["type"] = "boolean";
            break;
        case Key::Type::Word:
            schema["enum"] = wordsOf(key.words);
            break;
        case Key::Type::Text:
            schema["type"] = "string";
            break;
        case Key::Type::Vector:
            schema["type"] = "array";
            schema["items"] = {{"type", "number"}};
            schema["minItems"] = 3;
            schema["maxItems"] = 3;
            break;
        case Key::Type::Other:
            break;
    }
}

/// Adds the value of a key that is not given. JSON Schema takes it as a note.
void addDefault(Json& schema, const Key& key) {
    const Default& d = key.standard;
    if (d.kind != Default::Kind::Value) return;
    if (key.type == Key::Type::Word || key.type == Key::Type::Text)
        schema["default"] = d.text;
    else if (key.type == Key::Type::Boolean)
        schema["default"] = d.value[0] != 0;
    else if (key.type == Key::Type::Integer)
        schema["default"] = static_cast<std::int64_t>(d.value[0]);
    else if (key.type == Key::Type::Vector)
        schema["default"] = d.value;
    else
        schema["default"] = d.value[0];
}

Json schemaOf(const Key& key) {
    Json schema = Json::object();
    std::string text(key.meaning);
    if (*key.unit.name != '\0') text += " [" + std::string(key.unit.name) + "]";
    if (key.standard.kind == Default::Kind::Told) text += " (default: " + std::string(key.standard.text) + ")";
    schema["description"] = text;
    if (!key.orEnding.empty()) {
        std::string pattern(key.orEnding);
        pattern.replace(0, 1, "\\.");
        schema["anyOf"] =
            Json::array({{{"enum", wordsOf(key.words)}}, {{"type", "string"}, {"pattern", pattern + "$"}}});
    } else if (key.orWord.empty()) {
        addKind(schema, key);
    } else {
        Json number = Json::object();
        addKind(number, key);
        schema["anyOf"] = Json::array({number, {{"const", key.orWord}}});
    }
    addDefault(schema, key);
    return schema;
}

/// A table's schema. A key that is not known is refused, as the reader refuses it.
Json emptyTable() {
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

/// The table at `path` ("dose.stage[]") below `root`. Makes what is not there yet.
Json& tableAt(Json& root, std::string_view path) {
    Json* table = &root;
    while (!path.empty()) {
        const std::size_t dot = path.find('.');
        std::string name(path.substr(0, dot));
        path = dot == std::string_view::npos ? "" : path.substr(dot + 1);
        const bool list = name.ends_with("[]");
        if (list) name.resize(name.size() - 2);
        const bool pair = name == kPairOfNames;
        Json& place =
            pair ? (*table)["patternProperties"]["^[A-Za-z0-9_]+-[A-Za-z0-9_]+$"] : (*table)["properties"][name];
        if (place.is_null()) place = list ? Json{{"type", "array"}, {"items", emptyTable()}} : emptyTable();
        table = list ? &place["items"] : &place;
    }
    return *table;
}

/// Adds a key to a table. Two kinds of a table (a fixed and a normal distribution) may each have a key of this name;
/// then a value must fit one of the two.
void addKey(Json& table, const Key& key) {
    if (key.name.starts_with('"')) {  // stands for keys of any name
        table["additionalProperties"] = true;
        return;
    }
    Json& place = table["properties"][std::string(key.name)];
    const Json schema = schemaOf(key);
    if (place.is_null())
        place = schema;
    else if (place.contains("anyOf"))
        place["anyOf"].push_back(schema);
    else
        place = {{"anyOf", Json::array({place, schema})}};
}

/// A case over another one may change tables of a list by their names, `[body.gate]`, in place of the whole list.
void allowNames(Json& schema) {
    if (!schema.is_object()) return;
    for (auto& [name, value] : schema.items())
        if (value.is_structured()) allowNames(value);
    if (schema.value("type", "") != "array" || schema["items"].value("type", "") != "object") return;
    const Json named{{"type", "object"}, {"additionalProperties", schema["items"]}};
    schema = {{"anyOf", Json::array({schema, named})}};
}

}  // namespace

std::string keySchema(FileKind kind) {
    Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", kind == FileKind::Study    ? "a study of vkdose"
                        : kind == FileKind::Powder ? "a powder file of vkdose"
                                                   : "a case of vkdose"}};
    root.update(emptyTable());
    const auto add = [&](std::span<const KeyTable> tables, const auto& takes) {
        for (const KeyTable& table : tables) {
            std::vector<std::string> paths = wordsOf(table.paths);
            if (paths.empty()) paths.emplace_back();
            for (const std::string& path : paths)
                for (const Key& key : table.keys)
                    if (takes(path, key)) addKey(tableAt(root, path), key);
        }
    };
    add(keysOfKind(kind), [](const std::string&, const Key&) { return true; });
    if (kind == FileKind::Powder)  // it has tables of a case beside its own
        add(caseKeys(), [](const std::string& path, const Key& key) {
            return path.starts_with("particles") || path.starts_with("contact") || key.name == "bulk_density";
        });
    if (kind == FileKind::Case) allowNames(root);
    return root.dump(2) + "\n";
}

}  // namespace vkdose
