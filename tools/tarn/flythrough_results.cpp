#include "flythrough_results.h"

#include <cstdlib>
#include <fstream>

#include "bench/results.h"
#include "core/log.h"
#include "core/statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t FEWEST_VIDEO_FRAMES = 8;

// The first frame compiles shaders: its time is left out where there are others.
std::vector<double> frame_times(const std::vector<FlightFrame>& frames) {
    std::vector<double> ms;
    for (std::size_t i = frames.size() > 1 ? 1 : 0; i < frames.size(); ++i)
        ms.push_back(frames[i].timings.frame_ms);
    return ms;
}

Json describe_passes(const std::vector<FlightFrame>& frames) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<double>> ms;
    for (std::size_t i = frames.size() > 1 ? 1 : 0; i < frames.size(); ++i) {
        for (const PassTiming& pass : frames[i].timings.passes) {
            if (!ms.contains(pass.name)) order.push_back(pass.name);
            ms[pass.name].push_back(pass.ms);
        }
    }
    Json passes = Json::array();
    for (const std::string& name : order) {
        Json times = {{"median", quantile(ms[name], 0.5)}, {"p95", quantile(ms[name], 0.95)}};
        passes.push_back({{"name", name}, {"ms", times}});
    }
    return passes;
}

Json describe_errors(const Flight& flight, std::size_t method) {
    Json list = Json::array();
    for (const int number : flight.measured) {
        const FlightFrame& frame = flight.methods[method][std::size_t(number)];
        const ImageErrors& linear = frame.errors->linear;
        list.push_back({{"frame", number},
                        {"mse", linear.mse},
                        {"rel_mse", linear.rel_mse},
                        {"rel_mse_trimmed", linear.rel_mse_trimmed},
                        {"mape", linear.mape},
                        {"mean_ratio", linear.mean_ratio},
                        {"flip_ldr", frame.errors->flip_ldr},
                        {"flicker", frame.flicker}});
    }
    return list;
}

Json describe_pictures(const FlightPlan& plan, const Flight& flight) {
    Json list = Json::array();
    for (const int frame : flight.measured) {
        Json pictures = {{"reference", flight_reference_name(frame)}};
        for (std::size_t m = 0; m < plan.methods.size(); ++m) {
            pictures[plan.methods[m].label] = flight_picture_name(plan, m, frame);
        }
        list.push_back({{"frame", frame}, {"pictures", pictures}});
    }
    return list;
}

}  // namespace

Json describe_flight(const FlightPlan& plan, const Flight& flight, const std::string& scene,
                     const std::string& path_name) {
    Json json = {{"name", scene},
                 {"path", path_name},
                 {"frames", flight.methods.front().size()},
                 {"reference_spp", plan.reference_spp},
                 {"reference_relative_error", flight.reference_error},
                 {"exposure_ev", flight.exposure_ev.value_or(0.0f)},
                 {"interrupted", flight.interrupted}};
    json["methods"] = Json::array();
    for (std::size_t m = 0; m < plan.methods.size(); ++m) {
        const std::vector<double> ms = frame_times(flight.methods[m]);
        Json method = {{"label", plan.methods[m].label}, {"sentence", plan.methods[m].sentence}};
        method["settings"] = describe_settings(plan.methods[m].settings);
        method["frame_ms"] = {{"median", quantile(ms, 0.5)}, {"p95", quantile(ms, 0.95)}, {"per_frame", ms}};
        method["passes"] = describe_passes(flight.methods[m]);
        method["errors"] = describe_errors(flight, m);
        if (m < flight.counters.size()) method["counts"] = flight.counters[m];
        json["methods"].push_back(std::move(method));
    }
    json["measured"] = describe_pictures(plan, flight);
    return json;
}

void print_flight(const FlightPlan& plan, const Flight& flight) {
    for (std::size_t m = 0; m < plan.methods.size(); ++m) {
        const std::vector<double> ms = frame_times(flight.methods[m]);
        fmt::print("{}: {} frames, median {:.1f} ms, p95 {:.1f} ms a frame\n", plan.methods[m].label,
                   flight.methods[m].size(), quantile(ms, 0.5), quantile(ms, 0.95));
        for (const int number : flight.measured) {
            const FlightFrame& frame = flight.methods[m][std::size_t(number)];
            fmt::print("  frame {:4}: relMSE {:.4f}, FLIP {:.4f}, energy {:.4f}, flicker {:.4f}\n", number,
                       frame.errors->linear.rel_mse, frame.errors->flip_ldr, frame.errors->linear.mean_ratio,
                       frame.flicker);
        }
    }
}

void write_video(const FlightPlan& plan, const Flight& flight, const std::filesystem::path& out,
                 double duration_s) {
    if (flight.pictured.size() < FEWEST_VIDEO_FRAMES) return;
    if (std::system("command -v ffmpeg > /dev/null 2>&1") != 0) return;
    const std::filesystem::path list = out / "video.txt", video = out / "flythrough.mp4";
    {
        std::ofstream stream(list);
        for (const int frame : flight.pictured) {
            stream << "file '" << flight_picture_name(plan, 0, frame) << "'\nduration "
                   << duration_s / double(flight.pictured.size()) << "\n";
        }
    }
    // The folder travels in the environment: no quoting can go wrong.
    setenv("TARN_VIDEO_FOLDER", out.c_str(), 1);
    const int status = std::system(
        "cd \"$TARN_VIDEO_FOLDER\" && ffmpeg -nostdin -loglevel error -y -f concat -i video.txt "
        "-vf 'scale=trunc(iw/2)*2:trunc(ih/2)*2' -pix_fmt yuv420p flythrough.mp4 > /dev/null 2>&1");
    std::error_code ignored;
    std::filesystem::remove(list, ignored);
    if (status != 0) warn_once(fmt::format("{}: ffmpeg could not make it", video.string()));
}

}  // namespace tarn
