// Builds a tinygltf model and lets tinygltf write it.
#include "content/gltf_writer.h"

#include <stb_image_write.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "content/accessors.h"
#include "content/portable_math.h"
#include "content/tangents.h"
#include "core/error.h"

namespace tarn::content {
namespace {

std::vector<double> to_doubles(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}
std::vector<double> to_doubles(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

tinygltf::Value object(const std::string& key, double value) {
    return tinygltf::Value(tinygltf::Value::Object{{key, tinygltf::Value(value)}});
}

float largest(const glm::vec3& v) {
    return std::max(v.x, std::max(v.y, v.z));
}

// The rotation whose -Z looks along `forward`, +Y up.
glm::quat look_along(const glm::vec3& forward) {
    const glm::dvec3 back = glm::normalize(-glm::dvec3(forward));
    const glm::dvec3 helper = std::abs(back.y) > 0.999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(helper, back));
    return glm::quat(glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back))));
}

void append_bytes(void* buffer, void* data, int size) {
    const auto* bytes = static_cast<unsigned char*>(data);
    auto& out = *static_cast<std::vector<unsigned char>*>(buffer);
    out.insert(out.end(), bytes, bytes + size);
}

}  // namespace

struct GltfWriter::Impl {
    tinygltf::Model model;
    AccessorStore accessors{model};
    std::vector<MaterialSpec> specs;

    void use_extension(const std::string& name) {
        auto& used = model.extensionsUsed;
        if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
    }

    tinygltf::TextureInfo texture_info(int texture, float repeat_m) {
        tinygltf::TextureInfo info;
        info.index = texture;
        if (texture >= 0 && repeat_m != 1.0f) info.extensions = repeat(repeat_m);
        return info;
    }

    tinygltf::ExtensionMap repeat(float repeat_m) {
        use_extension("KHR_texture_transform");
        const double scale = 1.0 / static_cast<double>(repeat_m);
        const tinygltf::Value::Array both{tinygltf::Value(scale), tinygltf::Value(scale)};
        return {{"KHR_texture_transform",
                 tinygltf::Value(tinygltf::Value::Object{{"scale", tinygltf::Value(both)}})}};
    }

    void animate(int node, const char* path, Motion motion, const std::vector<float>& times_s,
                 const std::vector<std::vector<double>>& keys) {
        if (model.animations.empty()) model.animations.emplace_back().name = "life";
        tinygltf::Animation& animation = model.animations[0];
        tinygltf::AnimationSampler sampler;
        sampler.input = accessors.add_times(times_s);
        sampler.output = accessors.add_keys(motion == Motion::CUBIC ? loop_tangents(times_s, keys) : keys);
        sampler.interpolation = motion == Motion::CUBIC ? "CUBICSPLINE" : "LINEAR";
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation.samplers.size());
        channel.target_node = node;
        channel.target_path = path;
        animation.samplers.push_back(sampler);
        animation.channels.push_back(channel);
    }

    int add_light(const tinygltf::Light& light, const Placement& placement, GltfWriter& writer) {
        const int index = static_cast<int>(model.lights.size());
        model.lights.push_back(light);
        use_extension("KHR_lights_punctual");
        const int node = writer.add_node(light.name, placement);
        model.nodes[node].extensions["KHR_lights_punctual"] =
            tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(index)}});
        return index;
    }
};

GltfWriter::GltfWriter(const std::string& scene_name, std::uint64_t seed) : impl_(std::make_unique<Impl>()) {
    tinygltf::Model& model = impl_->model;
    model.asset.version = "2.0";
    model.asset.generator = fmt::format("tarn-content {} --seed {}", scene_name, seed);
    model.defaultScene = 0;
    model.scenes.emplace_back().name = scene_name;
    model.buffers.emplace_back();
}

GltfWriter::~GltfWriter() = default;

int GltfWriter::add_texture(const std::string& name, const Picture& picture) {
    std::vector<unsigned char> png;
    stbi_write_png_to_func(append_bytes, &png, picture.width, picture.height, picture.channels,
                           picture.bytes.data(), picture.width * picture.channels);
    tinygltf::Model& model = impl_->model;
    tinygltf::Image image;
    image.name = name;
    image.mimeType = "image/png";
    image.bufferView = impl_->accessors.add_view(png.data(), png.size(), 0);
    if (model.samplers.empty()) {
        tinygltf::Sampler sampler;
        sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        model.samplers.push_back(sampler);
    }
    tinygltf::Texture texture;
    texture.sampler = 0;
    texture.source = static_cast<int>(model.images.size());
    model.images.push_back(image);
    model.textures.push_back(texture);
    return static_cast<int>(model.textures.size()) - 1;
}

int GltfWriter::add_material(const MaterialSpec& spec) {
    tinygltf::Material material;
    material.name = spec.name;
    material.doubleSided = spec.double_sided;
    if (spec.alpha_mask) material.alphaMode = "MASK";
    tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor = {spec.base_color.r, spec.base_color.g, spec.base_color.b, 1.0};
    pbr.metallicFactor = spec.metallic;
    pbr.roughnessFactor = spec.roughness;
    pbr.baseColorTexture = impl_->texture_info(spec.base_color_texture, spec.texture_repeat_m);
    pbr.metallicRoughnessTexture =
        impl_->texture_info(spec.metallic_roughness_texture, spec.texture_repeat_m);
    material.emissiveTexture = impl_->texture_info(spec.emission_texture, spec.texture_repeat_m);
    material.normalTexture.index = spec.normal_texture;
    if (spec.normal_texture >= 0 && spec.texture_repeat_m != 1.0f) {
        material.normalTexture.extensions = impl_->repeat(spec.texture_repeat_m);
    }
    if (spec.specular != 1.0f) {
        impl_->use_extension("KHR_materials_specular");
        material.extensions["KHR_materials_specular"] = object("specularFactor", spec.specular);
    }
    if (const float strength = largest(spec.radiance); strength > 0.0f) {
        material.emissiveFactor = to_doubles(spec.radiance / strength);
        impl_->use_extension("KHR_materials_emissive_strength");
        material.extensions["KHR_materials_emissive_strength"] = object("emissiveStrength", strength);
    }
    impl_->model.materials.push_back(material);
    impl_->specs.push_back(spec);
    return static_cast<int>(impl_->specs.size()) - 1;
}

int GltfWriter::add_mesh(const std::string& name, const std::vector<Part>& parts) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    for (const auto& [shape, material] : parts) {
        const MaterialSpec& spec = impl_->specs.at(material);
        const bool textured = spec.base_color_texture >= 0 || spec.metallic_roughness_texture >= 0 ||
                              spec.normal_texture >= 0 || spec.emission_texture >= 0;
        AccessorStore& accessors = impl_->accessors;
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = material;
        primitive.indices = accessors.add_triangles(shape.triangles, shape.positions.size());
        primitive.attributes["POSITION"] = accessors.add_positions(shape.positions);
        primitive.attributes["NORMAL"] = accessors.add_vec3(shape.normals);
        if (textured) primitive.attributes["TEXCOORD_0"] = accessors.add_vec2(shape.uvs);
        if (spec.normal_texture >= 0)
            primitive.attributes["TANGENT"] = accessors.add_vec4(compute_tangents(shape));
        mesh.primitives.push_back(primitive);
    }
    impl_->model.meshes.push_back(mesh);
    return static_cast<int>(impl_->model.meshes.size()) - 1;
}

int GltfWriter::add_node(const std::string& name, const Placement& placement, int mesh, int parent) {
    tinygltf::Model& model = impl_->model;
    tinygltf::Node node;
    node.name = name;
    node.mesh = mesh;
    if (placement.translation != glm::vec3(0.0f)) node.translation = to_doubles(placement.translation);
    if (placement.rotation != glm::quat(1, 0, 0, 0)) node.rotation = to_doubles(placement.rotation);
    if (placement.scale != glm::vec3(1.0f)) node.scale = to_doubles(placement.scale);
    const int index = static_cast<int>(model.nodes.size());
    model.nodes.push_back(node);
    (parent < 0 ? model.scenes[0].nodes : model.nodes[parent].children).push_back(index);
    return index;
}

int GltfWriter::add_camera(const std::string& name, const glm::vec3& position, const glm::vec3& target,
                           double fov_deg) {
    tinygltf::Camera camera;
    camera.name = name;
    camera.type = "perspective";
    camera.perspective.yfov = fov_deg * (PI / 180.0);
    camera.perspective.znear = 0.05;
    const int node = add_node(name, {position, look_along(target - position)});
    tinygltf::Model& model = impl_->model;
    model.nodes[node].camera = static_cast<int>(model.cameras.size());
    model.cameras.push_back(camera);
    return model.nodes[node].camera;
}

int GltfWriter::add_point_light(const std::string& name, const glm::vec3& position, const glm::vec3& color,
                                double intensity) {
    tinygltf::Light light;
    light.name = name;
    light.type = "point";
    light.color = to_doubles(color);
    light.intensity = intensity;
    return impl_->add_light(light, {position}, *this);
}

int GltfWriter::add_directional_light(const std::string& name, const glm::vec3& towards,
                                      const glm::vec3& color, double irradiance) {
    tinygltf::Light light;
    light.name = name;
    light.type = "directional";
    light.color = to_doubles(color);
    light.intensity = irradiance;
    return impl_->add_light(light, {glm::vec3(0.0f), look_along(towards)}, *this);
}

void GltfWriter::animate_translation(int node, Motion motion, const std::vector<float>& times_s,
                                     const std::vector<glm::vec3>& keys) {
    std::vector<std::vector<double>> values;
    for (const glm::vec3& key : keys) values.push_back(to_doubles(key));
    impl_->animate(node, "translation", motion, times_s, values);
}

void GltfWriter::animate_rotation(int node, Motion motion, const std::vector<float>& times_s,
                                  const std::vector<glm::quat>& keys) {
    std::vector<std::vector<double>> values;
    for (const glm::quat& key : keys) values.push_back(to_doubles(key));
    impl_->animate(node, "rotation", motion, times_s, values);
}

std::string GltfWriter::to_bytes() {
    constexpr std::size_t LIMIT = 0xf0000000u;
    const std::size_t size = impl_->model.buffers[0].data.size();
    if (size > LIMIT) throw Error("scene data is {} bytes, a .glb file holds {}", size, LIMIT);
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    writer.WriteGltfSceneToStream(&impl_->model, stream, false, true);
    return std::move(stream).str();
}

void write_file(const std::string& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) throw Error("{}: cannot write {} bytes", path, bytes.size());
}

}  // namespace tarn::content
