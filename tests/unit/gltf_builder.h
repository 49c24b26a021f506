// Small glTF files made in a test: JSON with one buffer, written to a temporary file.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/gltf_import.h"

namespace tarn {

// A file that is deleted again. Each has a name of its own, for tests run side by side.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& suffix, const std::string& content) {
        static int serial = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("tarn_test_" + std::to_string(getpid()) + "_" + std::to_string(serial++) + suffix);
        std::ofstream(path_, std::ios::binary) << content;
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

class GltfBuilder {
  public:
    static constexpr int FLOAT = 5126;
    static constexpr int BYTE = 5120;
    static constexpr int UNSIGNED_BYTE = 5121;
    static constexpr int SHORT = 5122;
    static constexpr int UNSIGNED_SHORT = 5123;
    static constexpr int UNSIGNED_INT = 5125;

    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

    // Appends values to the buffer and returns the index of a buffer view over them.
    template <class Value>
    int add_view(const std::vector<Value>& values, int stride = 0) {
        while (bytes_.size() % 4 != 0) bytes_.push_back(0);
        const std::size_t offset = bytes_.size();
        bytes_.resize(offset + values.size() * sizeof(Value));
        if (!values.empty())
            std::memcpy(bytes_.data() + offset, values.data(), values.size() * sizeof(Value));
        nlohmann::json view = {
            {"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(Value)}};
        if (stride != 0) view["byteStride"] = stride;
        return push("bufferViews", view);
    }

    template <class Value>
    int add_accessor(const std::string& type, int component_type, std::size_t count,
                     const std::vector<Value>& values) {
        return push("accessors", {{"bufferView", add_view(values)},
                                  {"componentType", component_type},
                                  {"count", count},
                                  {"type", type}});
    }

    int add_floats(const std::string& type, std::size_t count, const std::vector<float>& values) {
        return add_accessor(type, FLOAT, count, values);
    }

    // Appends to a top-level array and returns the index.
    int push(const char* table, const nlohmann::json& entry) {
        json[table].push_back(entry);
        return int(json[table].size()) - 1;
    }

    int add_mesh(const nlohmann::json& primitive) { return push("meshes", {{"primitives", {primitive}}}); }

    // A mesh on a node of its own.
    void show(const nlohmann::json& primitive) { push("nodes", {{"mesh", add_mesh(primitive)}}); }

    // One triangle in the xy plane, (0,0,0) (1,0,0) (0,1,0).
    int add_triangle_positions() { return add_floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0}); }

    std::string text() const {
        nlohmann::json whole = json;
        if (!bytes_.empty()) {
            const std::string uri = "data:application/octet-stream;base64," + base64(bytes_);
            whole["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", uri}}};
        }
        return whole.dump();
    }

    Scene load(int scene_index = -1) const {
        const TemporaryFile file(".gltf", text());
        return load_gltf(file.path(), {.scene_index = scene_index});
    }

    static std::string base64(const std::vector<std::uint8_t>& bytes) {
        static constexpr char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < bytes.size(); i += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k)
                bits = (bits << 8) | (i + k < bytes.size() ? bytes[i + k] : 0u);
            for (std::size_t k = 0; k < 4; ++k) {
                text += i + k <= bytes.size() ? DIGITS[(bits >> (18 - 6 * k)) & 63] : '=';
            }
        }
        return text;
    }

  private:
    std::vector<std::uint8_t> bytes_;
};

// The message of the Error that `load` throws; empty where it throws none.
template <class Load>
std::string error_of(const Load& load) {
    try {
        load();
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

}  // namespace tarn
