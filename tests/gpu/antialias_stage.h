// Runs antialiasing over what a test gives for every ray: surfaces, where they were, and their radiance.
#pragma once

#include <functional>

#include "gpu/pass_context.h"
#include "passes/antialias/antialias.h"
#include "passes/antialias/jitter.h"
#include "passes/enlarge.h"
#include "shared/interface/constants/light_changes_cell.h"
#include "shared/math/colour.h"
#include "shared/math/display.h"

namespace tarn::test {

// What a ray meets.
struct Sight {
    glm::vec3 position{0.0f};
    glm::vec3 previous{0.0f};  // where that place was in the last frame
    glm::vec3 radiance{0.0f};
    glm::vec3 emission{0.0f};
    float alpha = 1.0f;  // GGX
    bool is_sky = false;
    float instance = 0.0f;
};

using SightOf = std::function<Sight(const glm::vec3& origin, const glm::vec3& direction)>;
using Pixels = std::vector<glm::vec3>;

class AntialiasStage {
  public:
    AntialiasStage(const glm::ivec2& output_px, double scale) : output_px_(output_px) {
        settings.antialias = {AntialiasMode::TAA, AntialiasMean::RADIANCE, scale};
        const float height = 0.5f;
        camera_.right = glm::vec3(height * float(output_px.x) / float(output_px.y), 0.0f, 0.0f);
        camera_.up = glm::vec3(0.0f, height, 0.0f);
        camera_.forward = glm::vec3(0.0f, 0.0f, -1.0f);
        camera_.orthographic = false;
        camera_.position = glm::vec3(0.0f);
        previous_camera_ = camera_;
    }

    RenderSettings settings;
    bool has_moved = false;       // since the last frame, whatever has
    bool scene_changed = false;   // the same without the camera
    std::optional<float> change;  // what find_light_changes finds, everywhere; none: it has not run
    std::function<void(std::vector<glm::vec4>& radiance)> spoil;  // of the next frames

    void plant(Defines defines) {
        defines.insert(defines.begin(), "TARN_MOTION");
        context_.plant(defines);
    }
    void move_camera(const glm::vec3& by) { camera_.position += by; }
    void forget() { history_ = {}; }
    void set_output(const glm::ivec2& output_px) { output_px_ = output_px; }

    glm::ivec2 size_px() const {
        return glm::ivec2(glm::round(glm::dvec2(output_px_) * settings.antialias.scale));
    }

    // The next frame, at the size of the output.
    Pixels render(const SightOf& sight) {
        plan_.antialias = plan_antialias(settings);
        jitter_px_ = find_jitter(frame_, plan_.antialias.jitter_count);
        context_.recorder().begin();
        std::vector<glm::vec4> radiance;
        const GBuffer gbuffer = write_surfaces(sight, radiance);
        if (spoil) spoil(radiance);
        bind_block();
        const Picture small = context_.write_picture("test/radiance", size_px(), GL_RGBA32F, radiance);
        const FrameContext base = context_.frame(size_px(), output_px_);
        FrameContext frame{base.recorder, base.programs, base.tracer,        base.counters, base.rays,
                           plan_,         settings,      base.scene_defines, size_px(),     output_px_};
        frame.has_moved = has_moved;
        frame.scene_changed = scene_changed;
        Picture changes;
        if (change) {
            const glm::ivec2 cells = (size_px() + CHANGE_CELL - 1) / CHANGE_CELL;
            const std::vector<float> values(std::size_t(cells.x) * std::size_t(cells.y), *change);
            changes = context_.write_picture("test/changes", cells, GL_R32F, values);
        }
        plan_.features.motion = true;
        const KeptPicture kept = antialias(frame, gbuffer, {small, changes}, history_.of_frame(frame_ - 1));
        history_.keep(frame_, kept);
        surfaces_.keep(frame_, gbuffer.surfaces);
        enlarged_ = settings.antialias.scale < 1.0 ? to_pixels(*enlarge(frame, small)) : Pixels();
        context_.recorder().end();
        previous_camera_ = camera_;
        previous_jitter_px_ = jitter_px_;
        ++frame_;
        return to_pixels(*kept.shown);
    }

    // The same frame without the past, enlarged bilinearly; where the scale is less than 1.
    const Pixels& enlarged() const { return enlarged_; }

    // What the present camera sees, a mean of `side` x `side` rays a pixel.
    Pixels integrate(const SightOf& sight, int side) const {
        Pixels result;
        for (int y = 0; y < output_px_.y; ++y) {
            for (int x = 0; x < output_px_.x; ++x) {
                glm::dvec3 sum(0.0);
                for (int i = 0; i < side * side; ++i) {
                    const glm::vec2 place =
                        (glm::vec2(float(i % side), float(i / side)) + 0.5f) / float(side);
                    const glm::vec2 at = glm::vec2(float(x), float(y)) + place;
                    sum += glm::dvec3(sight(camera_.position, direction(at, output_px_)).radiance);
                }
                result.emplace_back(sum / double(side * side));
            }
        }
        return result;
    }

    std::uint32_t count(std::uint32_t counter) const {
        return context_.counters().download<std::uint32_t>()[counter];
    }

  private:
    glm::vec3 direction(const glm::vec2& place_px, const glm::ivec2& size_px) const {
        return camera_ray(camera_, place_px, glm::vec2(size_px)).direction;
    }

    static Pixels to_pixels(const Texture2D& picture) {
        Pixels pixels;
        for (const glm::vec4& texel : picture.download<glm::vec4>()) pixels.emplace_back(texel);
        return pixels;
    }

    GBuffer write_surfaces(const SightOf& sight, std::vector<glm::vec4>& radiance) {
        std::vector<glm::vec4> position, diffuse, emission, motion;
        for (int y = 0; y < size_px().y; ++y) {
            for (int x = 0; x < size_px().x; ++x) {
                const glm::vec2 place = glm::vec2(float(x), float(y)) + 0.5f + jitter_px_;
                const Sight s = sight(camera_.position, direction(place, size_px()));
                position.push_back(s.is_sky ? glm::vec4(0.0f, 0.0f, 0.0f, -1.0f)
                                            : glm::vec4(s.position, 1e-6f));
                diffuse.emplace_back(0.5f, 0.5f, 0.5f, s.alpha);
                motion.emplace_back(s.previous, s.instance);
                emission.emplace_back(s.emission, 0.0f);
                const float brightness = luminance(s.radiance);
                radiance.emplace_back(s.radiance,
                                      1.0f + (brightness > 0.0f ? luminance(s.emission) / brightness : 0.0f));
            }
        }
        const Surfaces surfaces = std::make_shared<SurfaceTable>(size_px(), BufferUse::DYNAMIC);
        surfaces->upload(LAYER_POSITION, position);
        surfaces->upload(LAYER_DIFFUSE, diffuse);
        surfaces->upload(LAYER_EMISSION, emission);
        surfaces->upload(LAYER_MOTION, motion);
        context_.recorder().pass("test/write").write_image(0, surfaces->texels());
        std::optional<Previous<Surfaces>> previous = surfaces_.of_frame(frame_ - 1);
        if (previous && previous->value()->size_px() != size_px()) previous.reset();
        return {nullptr, surfaces, previous};
    }

    void bind_block() {
        FrameBlock block = make_camera_block(camera_, previous_camera_);
        block.frame_size = glm::uvec4(size_px(), frame_, 0u);
        block.frame_full = glm::uvec4(size_px(), 1u, 0u);
        block.frame_jitter = glm::vec4(jitter_px_, previous_jitter_px_);
        block_.upload(0, std::span<const FrameBlock>(&block, 1));
        context_.recorder().bind_frame_block(block_);
    }

    PassContext context_;
    glm::ivec2 output_px_;
    CameraRecord camera_{};
    CameraRecord previous_camera_{};
    glm::vec2 jitter_px_{0.0f};
    glm::vec2 previous_jitter_px_{0.0f};
    FramePlan plan_;
    History<KeptPicture> history_;
    History<Surfaces> surfaces_;
    Pixels enlarged_;
    std::uint32_t frame_ = 64;  // a multiple of the places in a pixel
    Buffer block_{"test/block", sizeof(FrameBlock), BufferUse::DYNAMIC};
};

// Root of the mean squared difference.
inline double rms_error(const Pixels& found, const Pixels& expected) {
    double sum = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const glm::dvec3 difference = glm::dvec3(found[i]) - glm::dvec3(expected[i]);
        sum += glm::dot(difference, difference) / 3.0;
    }
    return std::sqrt(sum / double(found.size()));
}

// NaN counts as 1e30.
inline double greatest_difference(const Pixels& found, const Pixels& expected) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double difference = std::abs(double(found[i][c]) - double(expected[i][c]));
            greatest = std::isfinite(difference) ? std::max(greatest, difference) : 1e30;
        }
    }
    return greatest;
}

}  // namespace tarn::test
