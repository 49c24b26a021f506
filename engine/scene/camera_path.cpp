#include "scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace tarn {
namespace {

using nlohmann::json;

double read_number(const json& object, const char* key, const std::string& where) {
    if (!object.contains(key) || !object[key].is_number())
        throw Error("{}: '{}' is not a number", where, key);
    const double value = object[key].get<double>();
    if (!std::isfinite(value)) throw Error("{}: '{}' is not finite", where, key);
    return value;
}

glm::dvec3 read_point(const json& object, const char* key, const std::string& where) {
    const json point = object.value(key, json());
    const bool valid = point.is_array() && point.size() == 3 &&
                       std::all_of(point.begin(), point.end(), [](const json& x) { return x.is_number(); });
    if (!valid) throw Error("{}: '{}' is not three numbers", where, key);
    return {point[0].get<double>(), point[1].get<double>(), point[2].get<double>()};
}

CameraKey read_key(const json& object, const std::string& where) {
    if (!object.is_object()) throw Error("{} is not an object", where);
    CameraKey key;
    key.time_s = read_number(object, "time_s", where);
    key.position_ws = read_point(object, "position", where);
    key.target_ws = read_point(object, "target", where);
    key.vertical_fov_deg = read_number(object, "fov_deg", where);
    if (key.vertical_fov_deg <= 0.0 || key.vertical_fov_deg >= 180.0) {
        throw Error("{}: 'fov_deg' is {}, must be between 0 and 180", where, key.vertical_fov_deg);
    }
    return key;
}

std::optional<glm::dvec3> read_optional_point(const json& object, const char* key, const std::string& where) {
    if (!object.contains(key)) return std::nullopt;
    return read_point(object, key, where);
}

NodeKey read_node_key(const json& object, const std::string& where) {
    if (!object.is_object()) throw Error("{} is not an object", where);
    NodeKey key;
    key.time_s = read_number(object, "time_s", where);
    key.position_ns = read_optional_point(object, "position", where);
    key.rotation_deg = read_optional_point(object, "rotation_deg", where);
    if (!key.position_ns && !key.rotation_deg) {
        throw Error("{}: has neither 'position' nor 'rotation_deg'", where);
    }
    return key;
}

// A list of keys, at least one, their times increasing. `what` they are keys of.
template <class Read>
auto read_keys(const json& object, const std::string& where, const char* what, const Read& read) {
    const json list = object.value("keys", json());
    if (!list.is_array() || list.empty()) throw Error("{}: 'keys' is not a list of {} keys", where, what);
    std::vector<decltype(read(list[0], where))> keys;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string key_where = fmt::format("{}: key {}", where, i);
        keys.push_back(read(list[i], key_where));
        if (i > 0 && keys[i].time_s <= keys[i - 1].time_s) {
            throw Error("{}: its time {} s is not after the key before", key_where, keys[i].time_s);
        }
    }
    return keys;
}

std::vector<NodeTrack> read_tracks(const json& document, const std::string& where) {
    const json list = document.value("tracks", json::array());
    if (!list.is_array()) throw Error("{}: 'tracks' is not a list", where);
    std::vector<NodeTrack> tracks;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string track_where = fmt::format("{}: track {}", where, i);
        const bool is_named = list[i].is_object() && list[i].contains("node") && list[i]["node"].is_string();
        if (!is_named) throw Error("{}: 'node' is not the name of a node", track_where);
        tracks.push_back({list[i]["node"], read_keys(list[i], track_where, "node", read_node_key)});
    }
    return tracks;
}

json read_json(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw Error("{}: cannot be opened", file.string());
    json document = json::parse(stream, nullptr, false);
    if (document.is_discarded() || !document.is_object())
        throw Error("{}: is not a JSON object", file.string());
    return document;
}

// Slope of `member` at key i: the difference of its neighbours over their time, one-sided at the ends.
template <class Member>
auto slope(const std::vector<CameraKey>& keys, std::size_t i, Member member) {
    const CameraKey& before = keys[i > 0 ? i - 1 : 0];
    const CameraKey& after = keys[std::min(i + 1, keys.size() - 1)];
    return (after.*member - before.*member) / (after.time_s - before.time_s);
}

// Cubic Hermite curve between keys i and i + 1.
template <class Member>
auto interpolate(const std::vector<CameraKey>& keys, std::size_t i, double u, Member member) {
    const double span_s = keys[i + 1].time_s - keys[i].time_s;
    const double u2 = u * u, u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * (keys[i].*member) +
           (u3 - 2.0 * u2 + u) * span_s * slope(keys, i, member) +
           (3.0 * u2 - 2.0 * u3) * (keys[i + 1].*member) + (u3 - u2) * span_s * slope(keys, i + 1, member);
}

}  // namespace

CameraPath load_camera_path(const std::filesystem::path& file) {
    const json document = read_json(file);
    CameraPath path;
    path.name = file.stem().string();
    if (document.contains("scene") && document["scene"].is_string()) path.scene = document["scene"];
    path.keys = read_keys(document, file.string(), "camera", read_key);
    path.tracks = read_tracks(document, file.string());
    path.duration_s = path.keys.back().time_s;
    return path;
}

CameraKey evaluate_camera_path(const CameraPath& path, double time_s) {
    const std::vector<CameraKey>& keys = path.keys;
    if (time_s <= keys.front().time_s) return keys.front();
    if (time_s >= keys.back().time_s) return keys.back();
    std::size_t i = 0;
    while (keys[i + 1].time_s <= time_s) ++i;
    const double u = (time_s - keys[i].time_s) / (keys[i + 1].time_s - keys[i].time_s);
    CameraKey key;
    key.time_s = time_s;
    key.position_ws = interpolate(keys, i, u, &CameraKey::position_ws);
    key.target_ws = interpolate(keys, i, u, &CameraKey::target_ws);
    key.vertical_fov_deg = interpolate(keys, i, u, &CameraKey::vertical_fov_deg);
    return key;
}

}  // namespace tarn
