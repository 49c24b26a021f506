// Key frames of node transforms and morph weights.
#include "scene/gltf_animations.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "scene/gltf_accessors.h"

namespace tarn {
namespace {

std::optional<AnimatedProperty> property_of(const std::string& path) {
    if (path == "translation") return AnimatedProperty::TRANSLATION;
    if (path == "rotation") return AnimatedProperty::ROTATION;
    if (path == "scale") return AnimatedProperty::SCALE;
    if (path == "weights") return AnimatedProperty::WEIGHTS;
    return std::nullopt;
}

Interpolation interpolation_of(const std::string& name, const std::string& label) {
    if (name == "LINEAR") return Interpolation::LINEAR;
    if (name == "STEP") return Interpolation::STEP;
    if (name == "CUBICSPLINE") return Interpolation::CUBIC;
    throw Error("{}: interpolation '{}' is unknown", label, name);
}

std::vector<float> read_times(const GltfDocument& document, int accessor, const std::string& label) {
    std::vector<float> times_s = read_elements<float>(document, accessor, label + " input");
    if (times_s.empty()) throw Error("{}: there are no key frames", label);
    for (std::size_t i = 1; i < times_s.size(); ++i) {
        if (times_s[i] < times_s[i - 1]) {
            throw Error("{}: key {} is at {} s, before key {} at {} s", label, i, times_s[i], i - 1,
                        times_s[i - 1]);
        }
    }
    return times_s;
}

std::size_t components_of(const Scene& scene, const AnimationChannel& channel) {
    switch (channel.property) {
        case AnimatedProperty::ROTATION:
            return 4;
        case AnimatedProperty::WEIGHTS:
            return at(scene.nodes, channel.node).morph_weights.size();
        default:
            return 3;
    }
}

void read_values(const GltfDocument& document, const Scene& scene, int accessor, const std::string& label,
                 AnimationChannel& channel) {
    const bool is_weights = channel.property == AnimatedProperty::WEIGHTS;
    const std::size_t components = components_of(scene, channel);
    expect_components(document, accessor, is_weights ? 1 : components, label + " output");
    const std::size_t values_per_key = channel.interpolation == Interpolation::CUBIC ? 3 : 1;
    const std::size_t expected = channel.times_s.size() * values_per_key * components;
    const std::size_t found = accessor_count(document, accessor) * (is_weights ? 1 : components);
    if (found != expected) {
        throw Error("{}: output has {} numbers, {} keys need {}", label, found, channel.times_s.size(),
                    expected);
    }
    channel.components = int(components);
    channel.values.resize(found);
    read_floats(document, accessor, channel.values);
}

// Of keys at the same time the last one counts.
void drop_repeated_keys(AnimationChannel& channel) {
    const std::size_t key_size = channel.values.size() / channel.times_s.size();
    std::size_t kept = 0;
    for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
        if (kept > 0 && channel.times_s[key] == channel.times_s[kept - 1]) --kept;
        channel.times_s[kept] = channel.times_s[key];
        const auto from = channel.values.begin() + std::ptrdiff_t(key * key_size);
        std::copy_n(from, key_size, channel.values.begin() + std::ptrdiff_t(kept * key_size));
        ++kept;
    }
    channel.times_s.resize(kept);
    channel.values.resize(kept * key_size);
}

// Checks every channel, also those that move nothing that is shown.
AnimationChannel read_channel(const GltfDocument& document, const Scene& scene,
                              const tinygltf::Animation& animation, const tinygltf::AnimationChannel& source,
                              AnimatedProperty property, const std::string& label) {
    const tinygltf::AnimationSampler& sampler = animation.samplers[std::size_t(source.sampler)];
    AnimationChannel channel;
    channel.node = NodeIndex(source.target_node);
    channel.property = property;
    channel.interpolation = interpolation_of(sampler.interpolation, label);
    if (property != AnimatedProperty::WEIGHTS && at(scene.nodes, channel.node).matrix) {
        throw Error("{} moves nodes[{}], which has a matrix instead of translation, rotation and scale",
                    label, source.target_node);
    }
    channel.times_s = read_times(document, sampler.input, label);
    read_values(document, scene, sampler.output, label, channel);
    drop_repeated_keys(channel);
    return channel;
}

}  // namespace

void add_animations(GltfDocument& document, Scene& scene) {
    for (std::size_t i = 0; i < document.model.animations.size(); ++i) {
        const tinygltf::Animation& source = document.model.animations[i];
        Animation& animation = scene.animations.emplace_back();
        animation.name = source.name;
        for (std::size_t k = 0; k < source.channels.size(); ++k) {
            const std::string label = fmt::format("animations[{}].channels[{}]", i, k);
            const auto property = property_of(source.channels[k].target_path);
            if (source.channels[k].target_node < 0 || !property) {
                document.warn(label + " moves nothing that is supported, it is ignored");
                continue;
            }
            const tinygltf::AnimationSampler& sampler =
                source.samplers[std::size_t(source.channels[k].sampler)];
            if (!has_data(document, sampler.input) || !has_data(document, sampler.output)) {
                document.warn(label + " reads a buffer without data, it is ignored");
                continue;
            }
            AnimationChannel channel =
                read_channel(document, scene, source, source.channels[k], *property, label);
            animation.duration_s = std::max(animation.duration_s, double(channel.times_s.back()));
            if (channel.components > 0) animation.channels.push_back(std::move(channel));
        }
    }
}

}  // namespace tarn
