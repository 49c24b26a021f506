# Import of glTF and evaluation of poses.
tarn_test(gltf_accessors LABEL unit LIBRARIES tarn_scene nlohmann_json::nlohmann_json)
tarn_test(gltf_meshes LABEL unit LIBRARIES tarn_scene nlohmann_json::nlohmann_json)
tarn_test(gltf_materials LABEL unit LIBRARIES tarn_scene nlohmann_json::nlohmann_json PkgConfig::STB)
tarn_test(gltf_nodes LABEL unit LIBRARIES tarn_scene nlohmann_json::nlohmann_json)
tarn_test(tangents LABEL unit LIBRARIES tarn_scene nlohmann_json::nlohmann_json)
tarn_test(pose LABEL unit LIBRARIES tarn_scene nlohmann_json::nlohmann_json)
tarn_test(live_pose LABEL unit LIBRARIES tarn_scene)
tarn_test(camera_path LABEL unit LIBRARIES tarn_scene nlohmann_json::nlohmann_json)
