// A glTF file taken apart and checked, before anything is made of it.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tarn {

// Every reference between the tables of `model` is in range, and its node graph is a forest.
struct GltfDocument {
    std::filesystem::path path;
    // Buffers hold their bytes (none: a buffer without uri); images hold uri, mimeType and bufferView alone.
    tinygltf::Model model;
    std::vector<std::size_t> buffer_lengths;  // byteLength of each buffer, also of those without bytes
    int no_data_view = -1;                    // a buffer view that stands for "no buffer view"
    std::vector<std::string> warnings;        // said once the whole file has proved good

    void warn(std::string message) { warnings.push_back(std::move(message)); }
};

// Reads, parses and checks a file. Throws Error for whatever would make its tables unsafe to index.
GltfDocument load_gltf_document(const std::filesystem::path& path);

}  // namespace tarn
