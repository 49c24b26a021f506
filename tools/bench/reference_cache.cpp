#include "bench/reference_cache.h"

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/hash.h"
#include "bench/reference_version.h"
#include "bench/work_folder.h"
#include "core/error.h"
#include "core/log.h"
#include "image_io/file.h"
#include "image_io/image_io.h"

namespace tarn {
namespace {

constexpr int CACHE_VERSION = 1;

// Field by field where a record has padding.
std::string hash_world(const World& world) {
    Hasher hasher;
    hasher.add_value(world.origin_ws);
    for (const WorldMesh& mesh : world.meshes) {
        for (const std::uint32_t value :
             {mesh.first_triangle, mesh.triangle_count, mesh.first_vertex, mesh.vertex_count}) {
            hasher.add_value(value);
        }
    }
    for (const WorldInstance& instance : world.instances) {
        hasher.add_value(instance.mesh);
        hasher.add_value(instance.world_from_object);
        hasher.add_value(std::uint32_t(instance.mirrored));
    }
    hasher.add(world.vertex_rows);
    hasher.add(world.triangles);
    hasher.add(world.instance_rows);
    hasher.add(world.material_rows);
    hasher.add(world.material_flags);
    hasher.add(world.texels);
    hasher.add(world.lights.rows);
    hasher.add(world.lights.alias_rows);
    hasher.add(world.lights.pmf);
    hasher.add(world.lights.instance_first);
    hasher.add(world.lights.light_of_primitive);
    hasher.add_value(world.environment.width);
    hasher.add_value(world.environment.height);
    hasher.add(world.environment.texels);
    hasher.add(world.environment.alias_rows);
    return hasher.text();
}

nlohmann::ordered_json describe(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

std::vector<float> interleave(const std::map<std::string, std::vector<float>>& channels,
                              const std::string& prefix, std::size_t pixel_count) {
    std::vector<float> values(3 * pixel_count);
    const char* const names[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<float>& channel = channels.at(prefix + names[c]);
        for (std::size_t i = 0; i < pixel_count; ++i) values[3 * i + c] = channel[i];
    }
    return values;
}

std::vector<ExrChannel> make_channels(const ReferenceResult& result) {
    std::vector<ExrChannel> channels;
    for (const auto& [prefix, image] :
         {std::pair("", &result.radiance), std::pair("variance.", &result.variance)}) {
        for (std::size_t c = 0; c < 3; ++c) {
            ExrChannel channel{std::string(prefix) + "RGB"[c], std::vector<float>(image->pixel_count())};
            for (std::size_t i = 0; i < channel.values.size(); ++i)
                channel.values[i] = image->values[3 * i + c];
            channels.push_back(std::move(channel));
        }
    }
    return channels;
}

ReferenceResult read_pictures(const std::filesystem::path& file) {
    int width = 0, height = 0;
    std::map<std::string, std::vector<float>> channels;
    for (ExrChannel& channel : read_exr_channels(file, width, height)) {
        channels[channel.name] = std::move(channel.values);
    }
    ReferenceResult result;
    result.radiance = Image(width, height, 3);
    result.variance = Image(width, height, 3);
    result.radiance.values = interleave(channels, "", result.radiance.pixel_count());
    result.variance.values = interleave(channels, "variance.", result.radiance.pixel_count());
    return result;
}

}  // namespace

std::string describe_reference_key(const World& world, const ReferenceSettings& settings) {
    const CameraRecord& camera = settings.camera;
    nlohmann::ordered_json key = {{"cache", CACHE_VERSION},
                                  {"code", REFERENCE_VERSION},
                                  {"rays", describe_ray_library()},
                                  {"world", hash_world(world)},
                                  {"width", settings.width},
                                  {"height", settings.height},
                                  {"bounces", settings.direct_only ? 1 : settings.bounces},
                                  {"spp", settings.spp},
                                  {"relative_error", settings.relative_error},
                                  {"seed", settings.seed},
                                  {"box_pixel_filter", settings.box_pixel_filter},
                                  {"strategy", int(settings.strategy)},
                                  {"light_tree", settings.light_tree},
                                  {"planted_bug", int(settings.planted_bug)}};
    key["camera"] = {describe(camera.position), describe(camera.right), describe(camera.up),
                     describe(camera.forward), camera.orthographic};
    return key.dump();
}

std::filesystem::path default_cache_folder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value != nullptr ? value : "");
    };
    if (!variable("TARN_CACHE_DIR").empty()) return variable("TARN_CACHE_DIR");
    if (!variable("XDG_CACHE_HOME").empty()) return variable("XDG_CACHE_HOME") / "tarn";
    return variable("HOME").empty() ? std::filesystem::path() : variable("HOME") / ".cache" / "tarn";
}

std::filesystem::path ReferenceCache::file(const std::string& key, const char* ending) const {
    return folder_ / "references" / (hash_text(key) + ending);
}

ReferenceResult ReferenceCache::load(const std::string& key) const {
    const std::filesystem::path note_file = file(key, ".json"), picture_file = file(key, ".exr");
    if (!std::filesystem::exists(note_file)) return {};
    try {
        const std::vector<unsigned char> text = load_file(note_file);
        const nlohmann::json note = nlohmann::json::parse(text);
        // The whole key, not its hash alone: what differs must never hit.
        if (note.at("key") != key) return {};
        const std::vector<unsigned char> bytes = load_file(picture_file);
        if (note.at("picture_hash") != hash_bytes(bytes)) {
            throw Error("{}: its content is not what was written", picture_file.string());
        }
        ReferenceResult result = read_pictures(picture_file);
        result.spp = note.at("spp");
        result.rays = note.at("rays");
        result.non_finite = note.at("non_finite");
        result.relative_error = note.at("relative_error");
        result.seconds = note.at("seconds");
        return result;
    } catch (const std::exception& damage) {
        warn_once(fmt::format("{}: damaged, rendered again ({})", picture_file.string(), damage.what()));
        return {};
    }
}

void ReferenceCache::store(const std::string& key, const ReferenceResult& result) const {
    const std::filesystem::path picture_file = file(key, ".exr");
    create_folder(picture_file.parent_path());
    write_exr(picture_file, result.radiance.width, result.radiance.height, make_channels(result));
    const std::vector<unsigned char> bytes = load_file(picture_file);
    write_json(file(key, ".json"), {{"key", key},
                                    {"picture_hash", hash_bytes(bytes)},
                                    {"spp", result.spp},
                                    {"rays", result.rays},
                                    {"non_finite", result.non_finite},
                                    {"relative_error", result.relative_error},
                                    {"seconds", result.seconds}});
}

ReferenceResult ReferenceCache::get(const World& world, const RayTracer& tracer,
                                    const ReferenceSettings& settings) const {
    if (folder_.empty()) return render_reference(world, tracer, settings);
    const std::string key = describe_reference_key(world, settings);
    ReferenceResult result = load(key);
    if (!result.radiance.empty()) return result;
    result = render_reference(world, tracer, settings);
    if (result.cancelled) return result;
    try {
        store(key, result);
    } catch (const std::exception& failure) {
        warn_once(fmt::format("the reference is not kept for later: {}", failure.what()));
    }
    return result;
}

}  // namespace tarn
