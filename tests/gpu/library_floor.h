// What the tests of the public surface share: a small scene, and frames of it.
#pragma once

#include <tarn/tarn.h>

#include <cstdint>
#include <fstream>
#include <string>

#include "support/process.h"

inline tarn::Frame frame_of(const tarn::Camera& camera, std::uint32_t number = 0) {
    tarn::Frame frame;
    frame.camera = camera;
    frame.number = number;
    frame.settings.set("direct", "ris");
    return frame;
}

inline double mean(const tarn::Picture& picture) {
    double sum = 0.0;
    for (const float value : picture.rgb) sum += value;
    return sum / double(picture.rgb.size());
}

template <class Work>
std::string error_of(const Work& work) {
    try {
        work();
    } catch (const tarn::Error& error) {
        return error.what();
    }
    return "";
}

// A floor of 2 x 2 m under a point light of 1 W/sr at 1 m, in a file of the folder.
inline std::string write_floor(const tarn::test::TemporaryFolder& folder) {
    const float corners[] = {-1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0, 1};
    const std::uint16_t indices[] = {0, 1, 2, 2, 1, 3};
    std::ofstream bin(folder.file("floor.bin"), std::ios::binary);
    bin.write(reinterpret_cast<const char*>(corners), sizeof(corners));
    bin.write(reinterpret_cast<const char*>(indices), sizeof(indices));
    std::ofstream(folder.file("floor.gltf")) << R"({"asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual"], "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 1}]}},
        "nodes": [{"name": "floor", "mesh": 0}, {"name": "lamp", "translation": [0, 1, 0],
            "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"uri": "floor.bin", "byteLength": 60}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                       "min": [-1, 0, -1], "max": [1, 0, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})";
    return folder.file("floor.gltf");
}

inline const tarn::Camera FROM_ABOVE = tarn::Camera::look_at({0.0, 1.5, 0.0}, {0.0, 0.0, 0.0}, 40.0);
