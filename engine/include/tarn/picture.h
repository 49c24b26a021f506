// What a view rendered, and what that cost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tarn::api {

struct PassTime {
    std::string name;  // "direct/candidates"
    double ms = 0.0;
    bool traces_rays = false;  // on worker threads
};

// A decision that the plan of a frame took, and why.
struct PlanReason {
    std::string name;    // a define of the shaders: "TARN_TEXTURES"
    std::string reason;  // "12 texture slots in use"
};

// The cost of a frame.
struct FrameReport {
    double frame_ms = 0.0;         // wall clock, from the first command to the last answer
    std::vector<PassTime> passes;  // in the order in which they ran
    std::uint64_t shadow_rays = 0;
    std::uint64_t closest_rays = 0;
    std::uint64_t camera_rays = 0;      // where they, not the rasterizer, find what pixels see
    std::uint64_t triangles_drawn = 0;  // rasterized; the rest is out of sight
    std::uint64_t triangles_total = 0;
    std::uint32_t averaged_frames = 1;  // that the picture is the mean of
    double relative_error =
        0.0;  // left in that mean: noise of its luminance, relative to it; 0: a single frame
    std::map<std::string, std::uint64_t>
        counters;                  // what was dropped or clamped since the view was made, by name
    std::vector<PlanReason> plan;  // what the shaders were compiled with
};

struct Picture {
    int width_px = 0;
    int height_px = 0;
    std::vector<float> rgb;  // [height][width][3]: linear radiance, row 0 on top
    FrameReport report;

    // The red, green and blue of a pixel; x from the left, y from the top.
    const float* pixel(int x, int y) const {
        return &rgb[3 * (std::size_t(y) * std::size_t(width_px) + std::size_t(x))];
    }

    // The exposure in EV that makes the picture's middle a middle grey, or less where more than 2 % of its
    // pixels, besides a few lamps, would be brighter than white; within +-20.
    float auto_exposure_ev() const;

    // Writes the radiance as 32-bit floats. The file is written whole or not at all. Error that names it.
    void write_exr(const std::filesystem::path& file) const;
    // Writes 8 bits a channel: radiance times 2^exposure_ev, tone-mapped, sRGB; nullopt: automatic exposure.
    void write_png(const std::filesystem::path& file, std::optional<float> exposure_ev = std::nullopt) const;
};

}  // namespace tarn::api
