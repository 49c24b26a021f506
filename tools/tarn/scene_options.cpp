#include "scene_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "bench/text.h"
#include "core/data_files.h"
#include "core/error.h"
#include "core/near_names.h"
#include "image_io/image_io.h"
#include "scene/gltf_import.h"

namespace tarn {
namespace {

constexpr int MAX_SIZE_PX = 16384;
constexpr double MAX_TIME_S = 1e6;

template <class Number>
std::optional<Number> parse_number(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

void parse_size(const std::string& text, SceneOptions& options) {
    const auto parts = split(text, 'x');
    const auto width = parse_number<int>(parts.front()), height = parse_number<int>(parts.back());
    const auto fits = [](const std::optional<int>& n) { return n && *n >= 1 && *n <= MAX_SIZE_PX; };
    if (parts.size() != 2 || !fits(width) || !fits(height)) {
        throw CLI::ValidationError(
            "--size", fmt::format("'{}' is not WIDTHxHEIGHT with numbers from 1 to {}", text, MAX_SIZE_PX));
    }
    options.width = *width;
    options.height = *height;
}

// Position, target and field of view, where `text` is seven numbers.
std::optional<std::vector<double>> parse_view(const std::string& text) {
    const auto parts = split(text, ',');
    if (parts.size() != 7) return std::nullopt;
    std::vector<double> numbers;
    for (const std::string& part : parts) {
        const auto number = parse_number<double>(part);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

std::string camera_name(const Scene& scene, const Camera& camera) {
    if (!camera.name.empty() || !camera.node.is_set()) return camera.name;
    return at(scene.nodes, camera.node).name;
}

std::string list_cameras(const std::vector<std::string>& names) {
    if (names.empty()) return "the scene has none";
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list += fmt::format("{}{} '{}'", i == 0 ? "the scene has " : ", ", i, names[i]);
    return list;
}

std::optional<std::size_t> find_camera(const std::string& text, const std::vector<std::string>& names) {
    const auto named = std::find(names.begin(), names.end(), text);
    if (named != names.end()) return std::size_t(named - names.begin());
    const auto index = parse_number<std::uint32_t>(text);
    return index && *index < names.size() ? std::optional<std::size_t>(*index) : std::nullopt;
}

}  // namespace

CLI::Validator make_finite_range(double minimum, double maximum) {
    const std::string range = fmt::format("[{} to {}]", minimum, maximum);
    const auto check = [=](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool fits = !text.empty() && *end == '\0' && value >= minimum && value <= maximum;
        return fits ? std::string() : fmt::format("'{}' is not a number in {}", text, range);
    };
    return CLI::Validator(check, range);
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
    command
        .add_option("SCENE", options.scene,
                    "A .gltf or .glb file, or the name of one of Tarn's scenes, such as lantern_court")
        ->required();
    command
        .add_option_function<std::string>(
            "--size", [&options](const std::string& text) { parse_size(text, options); },
            "Size of the picture, px")
        ->type_name("WxH")
        ->default_str(fmt::format("{}x{}", options.width, options.height));
    command
        .add_option("--camera", options.camera,
                    "Which camera (default: the scene's first, or a view of the whole)")
        ->type_name("NAME|INDEX|x,y,z,tx,ty,tz,fov_deg");
    command.add_option("--environment", options.environment, "Sky: equirectangular radiance")
        ->type_name("F.hdr|F.exr");
    command
        .add_option("--sky", options.sky,
                    "Even sky of this radiance (default: 1 where the scene has no light, else 0)")
        ->check(make_finite_range(0.0, 1e6))
        ->excludes(command.get_option("--environment"));
    command.add_option("--seed", options.seed, "Seed of all random numbers")->capture_default_str();
    command.add_option("--threads", options.threads, "Worker threads (0: one per core)")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command.add_option("--time", options.time_s, "Moment of the animation, s (default: the rest pose)")
        ->check(make_finite_range(-MAX_TIME_S, MAX_TIME_S));
    command.add_option("--scene", options.scene_index, "Index of the scene (default: the file's own choice)")
        ->check(CLI::NonNegativeNumber);
}

namespace {

std::vector<std::string> list_own_scenes(const DataFolder& content) {
    std::set<std::string> names;
    for (const std::filesystem::path& place : list_data_places(content)) {
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(place, ignored))
            if (entry.path().extension() == ".glb") names.insert(entry.path().stem().string());
    }
    return {names.begin(), names.end()};
}

}  // namespace

std::filesystem::path resolve_scene_path(const std::filesystem::path& scene) {
    if (std::filesystem::exists(scene) || scene.has_parent_path() || scene.has_extension()) return scene;
    constexpr DataFolder CONTENT = {"content", "TARN_CONTENT_DIR", TARN_CONTENT_DIR};
    if (const auto own = find_data_file(CONTENT, scene.string() + ".glb")) return *own;
    throw Error("scene '{}' is neither a file nor a scene of Tarn's own: {}{}", scene.string(),
                describe_data_places(CONTENT), suggest_names(scene.string(), list_own_scenes(CONTENT)));
}

LoadedScene load_scene(const SceneOptions& options, const SceneEdit& edit) {
    LoadedScene loaded;
    loaded.scene = load_gltf(resolve_scene_path(options.scene), GltfOptions{options.scene_index});
    if (edit) edit(loaded.scene);
    WorldOptions world_options;
    world_options.time_s = options.time_s;
    if (options.sky) world_options.environment = make_even_sky(*options.sky);
    if (options.environment) world_options.environment = read_radiance(*options.environment);
    loaded.world = build_world(loaded.scene, world_options);
    return loaded;
}

CameraChoice parse_camera(const std::string& text, const std::vector<std::string>& names) {
    CameraChoice choice;
    choice.index = find_camera(text, names);
    if (choice.index) return choice;
    const auto v = parse_view(text);
    if (!v) {
        throw Error("camera '{}' is neither a name, an index nor x,y,z,tx,ty,tz,fov_deg; {}", text,
                    list_cameras(names));
    }
    choice.position_ws = {(*v)[0], (*v)[1], (*v)[2]};
    choice.target_ws = {(*v)[3], (*v)[4], (*v)[5]};
    choice.vertical_fov_deg = (*v)[6];
    if (!(choice.vertical_fov_deg > 0.0 && choice.vertical_fov_deg < 180.0)) {
        throw Error("camera '{}': the field of view is {} degrees, it must lie between 0 and 180", text,
                    choice.vertical_fov_deg);
    }
    return choice;
}

CameraRecord choose_camera(const SceneOptions& options, const Scene& scene, const World& world) {
    const double aspect = double(options.width) / double(options.height);
    if (options.camera.empty()) {
        const auto first = scene_camera(scene, world, CameraIndex(0), aspect, options.time_s);
        return first ? *first : default_camera(world, aspect);
    }
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) names.push_back(camera_name(scene, camera));
    const CameraChoice choice = parse_camera(options.camera, names);
    if (choice.index) return *scene_camera(scene, world, CameraIndex(*choice.index), aspect, options.time_s);
    const auto& [px, py, pz] = choice.position_ws;
    const auto& [tx, ty, tz] = choice.target_ws;
    return look_at(world, {px, py, pz}, {tx, ty, tz}, choice.vertical_fov_deg, aspect);
}

}  // namespace tarn
