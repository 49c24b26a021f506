// From a path to a parsed and checked document: shell, JSON, schema, tinygltf, buffers, cross-checks.
//
// tinygltf turns the JSON into typed tables. It gets neither the buffers nor the images, because it loads
// both at once and trusts what they claim: here each claim is checked before memory is spent on it, and
// images are decoded only where a material needs them.
#include "scene/gltf_document.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/error.h"
#include "scene/gltf_checks.h"
#include "scene/gltf_container.h"
#include "scene/gltf_extensions.h"
#include "scene/gltf_schema.h"
#include "scene/gltf_uri.h"

namespace tarn {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t MAX_BUFFER_BYTES = 4ull << 30;

Json parse_json(const std::string& text) {
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        const std::string what = error.what();
        const std::size_t bracket = what.find("] ");
        throw Error("JSON: {}", bracket == std::string::npos ? what : what.substr(bracket + 2));
    }
}

// Integers written as 3.0 become 3, which tinygltf insists on; extras are dropped, since nothing reads them.
void normalize_json(Json& value) {
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number == std::floor(number) && std::abs(number) < 9e15) value = std::int64_t(number);
        return;
    }
    if (value.is_object()) value.erase("extras");
    if (value.is_structured()) {
        for (Json& child : value) normalize_json(child);
    }
}

Json take(Json& root, const char* name) {
    Json taken = root.contains(name) ? std::move(root[name]) : Json::array();
    root.erase(name);
    return taken;
}

// Unknown element types are allowed, to be used by extensions; here they are accessors without elements.
void replace_unknown_types(Json& root, std::vector<std::string>& warnings) {
    constexpr std::array<std::string_view, 7> KNOWN = {"SCALAR", "VEC2", "VEC3", "VEC4",
                                                       "MAT2",   "MAT3", "MAT4"};
    if (!root.contains("accessors")) return;
    Json& accessors = root["accessors"];
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const std::string type = accessors[i]["type"].get<std::string>();
        if (std::find(KNOWN.begin(), KNOWN.end(), type) != KNOWN.end()) continue;
        warnings.push_back(
            fmt::format("accessors[{}].type '{}' is unknown, the accessor is taken as empty", i, type));
        accessors[i]["type"] = "SCALAR";
        accessors[i]["count"] = 0;
        accessors[i].erase("sparse");
    }
}

// tinygltf refuses index accessors without a buffer view, which the specification allows (zeros, or sparse).
int add_no_data_view(Json& root) {
    Json& views = root["bufferViews"];
    if (views.is_null()) views = Json::array();
    const int index = int(views.size());
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    if (!root.contains("accessors")) return index;
    for (Json& accessor : root["accessors"]) {
        if (!accessor.contains("bufferView")) accessor["bufferView"] = index;
    }
    return index;
}

std::string join_lines(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    for (char& c : text) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    return text;
}

tinygltf::Model parse_model(const Json& root) {
    const std::string text = root.dump();
    if (text.size() > std::size_t(INT32_MAX)) throw Error("JSON of {} bytes is too large", text.size());
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), "")) {
        throw Error("{}", error.empty() ? "not a glTF 2.0 document" : join_lines(error));
    }
    return model;
}

std::vector<std::uint8_t> load_buffer(const Json& buffer, bool is_first, GltfContainer& container,
                                      const std::filesystem::path& folder) {
    if (buffer.contains("uri")) return load_uri(buffer["uri"].get<std::string>(), folder, MAX_BUFFER_BYTES);
    if (is_first && container.binary) return std::move(*container.binary);
    return {};
}

void load_buffers(GltfDocument& document, const Json& buffers, GltfContainer& container) {
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::size_t length = buffers[i]["byteLength"].get<std::size_t>();
        const bool has_source = buffers[i].contains("uri") || (i == 0 && container.binary);
        tinygltf::Buffer buffer;
        try {
            buffer.data = load_buffer(buffers[i], i == 0, container, document.path.parent_path());
        } catch (const Error& error) {
            throw Error("buffers[{}]: {}", i, error.what());
        }
        if (has_source && buffer.data.size() < length) {
            throw Error("buffers[{}].byteLength is {}, its data has {} bytes", i, length, buffer.data.size());
        }
        document.buffer_lengths.push_back(length);
        document.model.buffers.push_back(std::move(buffer));
    }
}

void describe_images(tinygltf::Model& model, const Json& images) {
    for (const Json& json : images) {
        tinygltf::Image image;
        image.name = json.value("name", "");
        image.uri = json.value("uri", "");
        image.mimeType = json.value("mimeType", "");
        image.bufferView = json.value("bufferView", -1);
        model.images.push_back(std::move(image));
    }
}

void check_version(const Json& asset) {
    const std::string version = asset["version"].get<std::string>();
    const std::string needed = asset.value("minVersion", version);
    const std::string& decisive = asset.contains("minVersion") ? needed : version;
    if (!version.starts_with("2.") || !decisive.starts_with("2.")) {
        throw Error("asset.version is '{}', only glTF 2 is supported", decisive);
    }
    if (asset.contains("minVersion") && needed != "2.0") {
        throw Error("asset.minVersion is '{}', 2.0 is supported", needed);
    }
}

}  // namespace

GltfDocument load_gltf_document(const std::filesystem::path& path) {
    GltfContainer container = read_gltf_container(path);
    Json root = parse_json(container.json);
    container.json.clear();
    if (!root.is_object()) throw Error("the document is {}, an object is expected", root.type_name());
    check_required_extensions(root);
    check_gltf_json(root);
    check_version(root["asset"]);
    normalize_json(root);

    GltfDocument document;
    document.path = path;
    const Json buffers = take(root, "buffers");
    const Json images = take(root, "images");
    replace_unknown_types(root, document.warnings);
    document.no_data_view = add_no_data_view(root);
    document.model = parse_model(root);
    load_buffers(document, buffers, container);
    describe_images(document.model, images);
    check_gltf_document(document);
    return document;
}

}  // namespace tarn
