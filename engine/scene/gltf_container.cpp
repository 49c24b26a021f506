// Reads .gltf and .glb shells (glTF 2.0 specification, chapter 4: GLB file format).
#include "scene/gltf_container.h"

#include <cstring>
#include <span>

#include "core/error.h"
#include "scene/gltf_uri.h"

namespace tarn {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t MAX_FILE_BYTES = 4ull << 30;
constexpr std::size_t MAX_JSON_BYTES = 1u << 30;
// Parsers recurse over JSON; glTF itself needs about ten levels, `extras` may hold more.
constexpr int MAX_JSON_DEPTH = 128;

constexpr std::uint32_t GLB_MAGIC = 0x46546C67;
constexpr std::uint32_t CHUNK_JSON = 0x4E4F534A;
constexpr std::uint32_t CHUNK_BIN = 0x004E4942;
constexpr std::size_t HEADER_BYTES = 12;
constexpr std::size_t CHUNK_HEADER_BYTES = 8;

std::uint32_t read_u32(Bytes bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

struct Chunk {
    std::uint32_t type = 0;
    Bytes payload;
};

Chunk read_chunk(Bytes file, std::size_t offset) {
    if (file.size() - offset < CHUNK_HEADER_BYTES) {
        throw Error("GLB chunk header at byte {} is cut off, the file ends at {}", offset, file.size());
    }
    const std::size_t length = read_u32(file, offset);
    const std::size_t available = file.size() - offset - CHUNK_HEADER_BYTES;
    if (length > available) {
        throw Error("GLB chunk at byte {} claims {} bytes, {} are left", offset, length, available);
    }
    if (length % 4 != 0)
        throw Error("GLB chunk at byte {} has {} bytes, not a multiple of 4", offset, length);
    return {read_u32(file, offset + 4), file.subspan(offset + CHUNK_HEADER_BYTES, length)};
}

// The part of the file that its GLB header speaks of; bytes behind it are ignored.
Bytes check_glb_header(Bytes file) {
    if (file.size() < HEADER_BYTES) throw Error("GLB header is cut off after {} bytes", file.size());
    const std::uint32_t version = read_u32(file, 4);
    const std::size_t length = read_u32(file, 8);
    if (version != 2) throw Error("GLB version is {}, only 2 is supported", version);
    if (length > file.size()) throw Error("GLB header claims {} bytes, the file has {}", length, file.size());
    if (length < HEADER_BYTES + CHUNK_HEADER_BYTES) {
        throw Error("GLB header claims {} bytes, too few for one chunk", length);
    }
    return file.first(length);
}

GltfContainer open_glb(Bytes file) {
    const Bytes glb = check_glb_header(file);
    const Chunk json = read_chunk(glb, HEADER_BYTES);
    if (json.type != CHUNK_JSON) throw Error("the first GLB chunk is of type {:#x}, not JSON", json.type);
    if (json.payload.empty()) throw Error("the GLB's JSON chunk is empty");
    GltfContainer container;
    container.json.assign(json.payload.begin(), json.payload.end());
    std::size_t offset = HEADER_BYTES + CHUNK_HEADER_BYTES + json.payload.size();
    while (offset < glb.size()) {
        const Chunk chunk = read_chunk(glb, offset);
        if (chunk.type == CHUNK_BIN) {
            if (container.binary) throw Error("the GLB has two BIN chunks");
            container.binary.emplace(chunk.payload.begin(), chunk.payload.end());
        }
        offset += CHUNK_HEADER_BYTES + chunk.payload.size();
    }
    return container;
}

void check_json_depth(const std::string& json) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > MAX_JSON_DEPTH) throw Error("JSON is nested deeper than {} levels", MAX_JSON_DEPTH);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

}  // namespace

GltfContainer read_gltf_container(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file_bytes(path, MAX_FILE_BYTES);
    GltfContainer container;
    if (bytes.size() >= 4 && read_u32(bytes, 0) == GLB_MAGIC) {
        container = open_glb(bytes);
    } else {
        if (bytes.size() > MAX_JSON_BYTES) {
            throw Error("the file has {} bytes of JSON, the limit is {}", bytes.size(), MAX_JSON_BYTES);
        }
        container.json.assign(bytes.begin(), bytes.end());
    }
    check_json_depth(container.json);
    return container;
}

}  // namespace tarn
