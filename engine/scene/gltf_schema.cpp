// Table-driven check of a glTF document (glTF 2.0 specification, chapter 5: properties reference).
#include "scene/gltf_schema.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "core/error.h"

namespace tarn {
namespace {

using Json = nlohmann::json;

enum class Kind {
    BOOLEAN,
    NUMBER,
    STRING,
    COUNT,       // integer >= 0
    INDEX,       // into the top-level array `table`
    OBJECT,      // of `type`
    NUMBERS,     // array; of `length` numbers where that is not 0
    INDICES,     // array, into `table`
    STRINGS,     // array
    OBJECTS,     // array, of `type`
    ATTRIBUTES,  // object of indices into `table`
    TARGETS,     // array of ATTRIBUTES
};

struct ObjectType;

struct Property {
    const char* name;
    Kind kind;
    bool required = false;
    const char* table = nullptr;
    const ObjectType* type = nullptr;
    std::size_t length = 0;
};

struct ObjectType {
    std::span<const Property> properties;
};

constexpr bool REQUIRED = true;
constexpr bool OPTIONAL = false;

// Offsets and counts must survive being stored as int by the parser.
constexpr std::int64_t MAX_COUNT = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t MAX_BYTES = std::int64_t(1) << 40;

#define TARN_OBJECT_TYPE(NAME, ...)                         \
    constexpr Property NAME##_PROPERTIES[] = {__VA_ARGS__}; \
    constexpr ObjectType NAME = {NAME##_PROPERTIES}

// clang-format off
TARN_OBJECT_TYPE(ASSET, {"version", Kind::STRING, REQUIRED}, {"minVersion", Kind::STRING});
TARN_OBJECT_TYPE(BUFFER, {"byteLength", Kind::COUNT, REQUIRED}, {"uri", Kind::STRING});
TARN_OBJECT_TYPE(BUFFER_VIEW,
    {"buffer", Kind::INDEX, REQUIRED, "buffers"}, {"byteOffset", Kind::COUNT},
    {"byteLength", Kind::COUNT, REQUIRED}, {"byteStride", Kind::COUNT});
TARN_OBJECT_TYPE(SPARSE_INDICES,
    {"bufferView", Kind::INDEX, REQUIRED, "bufferViews"}, {"byteOffset", Kind::COUNT},
    {"componentType", Kind::COUNT, REQUIRED});
TARN_OBJECT_TYPE(SPARSE_VALUES,
    {"bufferView", Kind::INDEX, REQUIRED, "bufferViews"}, {"byteOffset", Kind::COUNT});
TARN_OBJECT_TYPE(SPARSE,
    {"count", Kind::COUNT, REQUIRED}, {"indices", Kind::OBJECT, REQUIRED, nullptr, &SPARSE_INDICES},
    {"values", Kind::OBJECT, REQUIRED, nullptr, &SPARSE_VALUES});
TARN_OBJECT_TYPE(ACCESSOR,
    {"bufferView", Kind::INDEX, OPTIONAL, "bufferViews"}, {"byteOffset", Kind::COUNT},
    {"componentType", Kind::COUNT, REQUIRED}, {"count", Kind::COUNT, REQUIRED},
    {"type", Kind::STRING, REQUIRED}, {"normalized", Kind::BOOLEAN},
    {"sparse", Kind::OBJECT, OPTIONAL, nullptr, &SPARSE});
TARN_OBJECT_TYPE(PRIMITIVE,
    {"attributes", Kind::ATTRIBUTES, REQUIRED, "accessors"}, {"indices", Kind::INDEX, OPTIONAL, "accessors"},
    {"material", Kind::INDEX, OPTIONAL, "materials"}, {"mode", Kind::COUNT},
    {"targets", Kind::TARGETS, OPTIONAL, "accessors"});
TARN_OBJECT_TYPE(MESH,
    {"name", Kind::STRING}, {"primitives", Kind::OBJECTS, REQUIRED, nullptr, &PRIMITIVE},
    {"weights", Kind::NUMBERS});
TARN_OBJECT_TYPE(NODE_LIGHT, {"light", Kind::COUNT, REQUIRED});
TARN_OBJECT_TYPE(NODE_EXTENSIONS, {"KHR_lights_punctual", Kind::OBJECT, OPTIONAL, nullptr, &NODE_LIGHT});
TARN_OBJECT_TYPE(NODE,
    {"name", Kind::STRING}, {"camera", Kind::INDEX, OPTIONAL, "cameras"},
    {"children", Kind::INDICES, OPTIONAL, "nodes"}, {"skin", Kind::INDEX, OPTIONAL, "skins"},
    {"mesh", Kind::INDEX, OPTIONAL, "meshes"}, {"matrix", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 16},
    {"rotation", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 4},
    {"scale", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 3},
    {"translation", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 3}, {"weights", Kind::NUMBERS},
    {"extensions", Kind::OBJECT, OPTIONAL, nullptr, &NODE_EXTENSIONS});
TARN_OBJECT_TYPE(SCENE, {"name", Kind::STRING}, {"nodes", Kind::INDICES, OPTIONAL, "nodes"});
TARN_OBJECT_TYPE(TEXTURE_TRANSFORM,
    {"offset", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 2}, {"rotation", Kind::NUMBER},
    {"scale", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 2}, {"texCoord", Kind::COUNT});
TARN_OBJECT_TYPE(TEXTURE_INFO_EXTENSIONS,
    {"KHR_texture_transform", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_TRANSFORM});
TARN_OBJECT_TYPE(TEXTURE_INFO,
    {"index", Kind::INDEX, REQUIRED, "textures"}, {"texCoord", Kind::COUNT}, {"scale", Kind::NUMBER},
    {"strength", Kind::NUMBER}, {"extensions", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO_EXTENSIONS});
TARN_OBJECT_TYPE(METALLIC_ROUGHNESS,
    {"baseColorFactor", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 4}, {"metallicFactor", Kind::NUMBER},
    {"roughnessFactor", Kind::NUMBER}, {"baseColorTexture", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO},
    {"metallicRoughnessTexture", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO});
TARN_OBJECT_TYPE(EMISSIVE_STRENGTH, {"emissiveStrength", Kind::NUMBER});
TARN_OBJECT_TYPE(IOR, {"ior", Kind::NUMBER});
TARN_OBJECT_TYPE(SPECULAR,
    {"specularFactor", Kind::NUMBER}, {"specularColorFactor", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 3},
    {"specularTexture", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO},
    {"specularColorTexture", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO});
TARN_OBJECT_TYPE(MATERIAL_EXTENSIONS,
    {"KHR_materials_emissive_strength", Kind::OBJECT, OPTIONAL, nullptr, &EMISSIVE_STRENGTH},
    {"KHR_materials_ior", Kind::OBJECT, OPTIONAL, nullptr, &IOR},
    {"KHR_materials_specular", Kind::OBJECT, OPTIONAL, nullptr, &SPECULAR});
TARN_OBJECT_TYPE(MATERIAL,
    {"name", Kind::STRING}, {"alphaCutoff", Kind::NUMBER}, {"alphaMode", Kind::STRING},
    {"doubleSided", Kind::BOOLEAN}, {"emissiveFactor", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 3},
    {"pbrMetallicRoughness", Kind::OBJECT, OPTIONAL, nullptr, &METALLIC_ROUGHNESS},
    {"normalTexture", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO},
    {"occlusionTexture", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO},
    {"emissiveTexture", Kind::OBJECT, OPTIONAL, nullptr, &TEXTURE_INFO},
    {"extensions", Kind::OBJECT, OPTIONAL, nullptr, &MATERIAL_EXTENSIONS});
TARN_OBJECT_TYPE(TEXTURE,
    {"name", Kind::STRING}, {"sampler", Kind::INDEX, OPTIONAL, "samplers"},
    {"source", Kind::INDEX, OPTIONAL, "images"});
TARN_OBJECT_TYPE(IMAGE,
    {"name", Kind::STRING}, {"uri", Kind::STRING}, {"mimeType", Kind::STRING},
    {"bufferView", Kind::INDEX, OPTIONAL, "bufferViews"});
TARN_OBJECT_TYPE(SAMPLER,
    {"magFilter", Kind::COUNT}, {"minFilter", Kind::COUNT}, {"wrapS", Kind::COUNT}, {"wrapT", Kind::COUNT});
TARN_OBJECT_TYPE(SKIN,
    {"name", Kind::STRING}, {"inverseBindMatrices", Kind::INDEX, OPTIONAL, "accessors"},
    {"skeleton", Kind::INDEX, OPTIONAL, "nodes"}, {"joints", Kind::INDICES, REQUIRED, "nodes"});
TARN_OBJECT_TYPE(CHANNEL_TARGET, {"node", Kind::INDEX, OPTIONAL, "nodes"}, {"path", Kind::STRING, REQUIRED});
TARN_OBJECT_TYPE(CHANNEL,
    {"sampler", Kind::COUNT, REQUIRED}, {"target", Kind::OBJECT, REQUIRED, nullptr, &CHANNEL_TARGET});
TARN_OBJECT_TYPE(ANIMATION_SAMPLER,
    {"input", Kind::INDEX, REQUIRED, "accessors"}, {"output", Kind::INDEX, REQUIRED, "accessors"},
    {"interpolation", Kind::STRING});
TARN_OBJECT_TYPE(ANIMATION,
    {"name", Kind::STRING}, {"channels", Kind::OBJECTS, REQUIRED, nullptr, &CHANNEL},
    {"samplers", Kind::OBJECTS, REQUIRED, nullptr, &ANIMATION_SAMPLER});
TARN_OBJECT_TYPE(PERSPECTIVE,
    {"yfov", Kind::NUMBER, REQUIRED}, {"znear", Kind::NUMBER, REQUIRED}, {"zfar", Kind::NUMBER},
    {"aspectRatio", Kind::NUMBER});
TARN_OBJECT_TYPE(ORTHOGRAPHIC,
    {"xmag", Kind::NUMBER, REQUIRED}, {"ymag", Kind::NUMBER, REQUIRED}, {"zfar", Kind::NUMBER, REQUIRED},
    {"znear", Kind::NUMBER, REQUIRED});
TARN_OBJECT_TYPE(CAMERA,
    {"name", Kind::STRING}, {"type", Kind::STRING, REQUIRED},
    {"perspective", Kind::OBJECT, OPTIONAL, nullptr, &PERSPECTIVE},
    {"orthographic", Kind::OBJECT, OPTIONAL, nullptr, &ORTHOGRAPHIC});
TARN_OBJECT_TYPE(SPOT, {"innerConeAngle", Kind::NUMBER}, {"outerConeAngle", Kind::NUMBER});
TARN_OBJECT_TYPE(LIGHT,
    {"name", Kind::STRING}, {"type", Kind::STRING, REQUIRED},
    {"color", Kind::NUMBERS, OPTIONAL, nullptr, nullptr, 3}, {"intensity", Kind::NUMBER},
    {"range", Kind::NUMBER}, {"spot", Kind::OBJECT, OPTIONAL, nullptr, &SPOT});
TARN_OBJECT_TYPE(LIGHTS, {"lights", Kind::OBJECTS, REQUIRED, nullptr, &LIGHT});
TARN_OBJECT_TYPE(ROOT_EXTENSIONS, {"KHR_lights_punctual", Kind::OBJECT, OPTIONAL, nullptr, &LIGHTS});
TARN_OBJECT_TYPE(ROOT,
    {"asset", Kind::OBJECT, REQUIRED, nullptr, &ASSET},
    {"extensionsUsed", Kind::STRINGS}, {"extensionsRequired", Kind::STRINGS},
    {"buffers", Kind::OBJECTS, OPTIONAL, nullptr, &BUFFER},
    {"bufferViews", Kind::OBJECTS, OPTIONAL, nullptr, &BUFFER_VIEW},
    {"accessors", Kind::OBJECTS, OPTIONAL, nullptr, &ACCESSOR},
    {"meshes", Kind::OBJECTS, OPTIONAL, nullptr, &MESH},
    {"nodes", Kind::OBJECTS, OPTIONAL, nullptr, &NODE},
    {"scenes", Kind::OBJECTS, OPTIONAL, nullptr, &SCENE},
    {"scene", Kind::INDEX, OPTIONAL, "scenes"},
    {"materials", Kind::OBJECTS, OPTIONAL, nullptr, &MATERIAL},
    {"textures", Kind::OBJECTS, OPTIONAL, nullptr, &TEXTURE},
    {"images", Kind::OBJECTS, OPTIONAL, nullptr, &IMAGE},
    {"samplers", Kind::OBJECTS, OPTIONAL, nullptr, &SAMPLER},
    {"skins", Kind::OBJECTS, OPTIONAL, nullptr, &SKIN},
    {"animations", Kind::OBJECTS, OPTIONAL, nullptr, &ANIMATION},
    {"cameras", Kind::OBJECTS, OPTIONAL, nullptr, &CAMERA},
    {"extensions", Kind::OBJECT, OPTIONAL, nullptr, &ROOT_EXTENSIONS});
// clang-format on

#undef TARN_OBJECT_TYPE

class Checker {
  public:
    explicit Checker(const Json& root) : root_(root) {}

    void check_object(const Json& object, const ObjectType& type, const std::string& path) const {
        if (!object.is_object())
            throw Error("{} is {}, an object is expected", shown(path), object.type_name());
        for (const Property& property : type.properties) {
            const std::string here = path.empty() ? property.name : path + "." + property.name;
            const auto found = object.find(property.name);
            if (found == object.end()) {
                if (property.required) throw Error("{} is missing", here);
                continue;
            }
            check_property(*found, property, here);
        }
    }

  private:
    static std::string shown(const std::string& path) { return path.empty() ? "the document" : path; }

    void check_property(const Json& value, const Property& property, const std::string& path) const {
        switch (property.kind) {
            case Kind::BOOLEAN:
                expect(value.is_boolean(), value, path, "true or false");
                break;
            case Kind::STRING:
                expect(value.is_string(), value, path, "a string");
                break;
            case Kind::NUMBER:
                check_number(value, path);
                break;
            case Kind::COUNT:
                check_count(value, path);
                break;
            case Kind::INDEX:
                check_index(value, property.table, path);
                break;
            case Kind::OBJECT:
                check_object(value, *property.type, path);
                break;
            case Kind::ATTRIBUTES:
                check_attributes(value, property.table, path);
                break;
            default:
                check_array(value, property, path);
        }
    }

    void check_array(const Json& array, const Property& property, const std::string& path) const {
        expect(array.is_array(), array, path, "an array");
        if (property.length != 0 && array.size() != property.length) {
            throw Error("{} has {} entries, {} are expected", path, array.size(), property.length);
        }
        for (std::size_t i = 0; i < array.size(); ++i) {
            const std::string here = fmt::format("{}[{}]", path, i);
            if (property.kind == Kind::NUMBERS) check_number(array[i], here);
            if (property.kind == Kind::INDICES) check_index(array[i], property.table, here);
            if (property.kind == Kind::STRINGS) expect(array[i].is_string(), array[i], here, "a string");
            if (property.kind == Kind::OBJECTS) check_object(array[i], *property.type, here);
            if (property.kind == Kind::TARGETS) check_attributes(array[i], property.table, here);
        }
    }

    void check_attributes(const Json& object, const char* table, const std::string& path) const {
        expect(object.is_object(), object, path, "an object");
        for (const auto& [name, value] : object.items()) check_index(value, table, path + "." + name);
    }

    static void expect(bool holds, const Json& value, const std::string& path, const char* wanted) {
        if (!holds) throw Error("{} is {}, {} is expected", path, value.type_name(), wanted);
    }

    static void check_number(const Json& value, const std::string& path) {
        expect(value.is_number(), value, path, "a number");
        const double number = value.get<double>();
        if (!(std::abs(number) <= double(std::numeric_limits<float>::max()))) {
            throw Error("{} is {}, beyond what single precision holds", path, number);
        }
    }

    // The integer in `value`, which may be written as 3.0.
    static std::int64_t check_count(const Json& value, const std::string& path) {
        check_number(value, path);
        const double number = value.get<double>();
        if (number != std::floor(number) || number < 0) {
            throw Error("{} is {}, an integer >= 0 is expected", path, number);
        }
        const bool counts_bytes = path.ends_with("byteLength") || path.ends_with("byteOffset");
        const bool is_sparse = path.find(".sparse.") != std::string::npos;
        const std::int64_t limit = counts_bytes && !is_sparse ? MAX_BYTES : MAX_COUNT;
        if (number > double(limit)) throw Error("{} is {}, the limit is {}", path, number, limit);
        return std::int64_t(number);
    }

    void check_index(const Json& value, const char* table, const std::string& path) const {
        const std::int64_t index = check_count(value, path);
        const auto entries = root_.find(table);
        const std::size_t size = entries != root_.end() && entries->is_array() ? entries->size() : 0;
        if (std::size_t(index) >= size) throw Error("{} is {}, {} has {} entries", path, index, table, size);
    }

    const Json& root_;
};

}  // namespace

void check_gltf_json(const nlohmann::json& root) {
    Checker(root).check_object(root, ROOT, "");
}

}  // namespace tarn
