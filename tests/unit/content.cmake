tarn_test(content LABEL unit LIBRARIES tarn_content PkgConfig::TINYGLTF nlohmann_json::nlohmann_json)
