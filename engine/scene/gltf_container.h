// The outer shell of a glTF file: .gltf is JSON text, .glb is a header with chunks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tarn {

struct GltfContainer {
    std::string json;
    std::optional<std::vector<std::uint8_t>> binary;  // the BIN chunk of a .glb
};

// Reads a file and takes its shell off. What it is, is decided by its first bytes, not by its name.
// Throws Error for an unreadable file, a broken header, chunks that do not fit, or JSON nested too deep.
GltfContainer read_gltf_container(const std::filesystem::path& path);

}  // namespace tarn
