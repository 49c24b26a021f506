// Runs the denoiser over surfaces and light that a test gives for each pixel.
#pragma once

#include <cmath>
#include <functional>
#include <map>

#include "gpu/pass_context.h"
#include "passes/antialias/jitter.h"
#include "passes/denoise/denoise.h"
#include "shared/math/brdf.h"
#include "shared/math/packing.h"

namespace tarn::test {

// What a ray meets.
struct Met {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    int thing = 0;
    bool lit = true;
};

using SceneOf = std::function<Met(const glm::vec3& origin, const glm::vec3& direction)>;
// Light without albedo: base, and what arrives at the layer.
using LightOf = std::function<glm::vec2(const glm::ivec2& pixel, const Met& met)>;

constexpr glm::vec3 F0(0.04f);

// The share of arriving light that the layer reflects, by the formula of the BRDF's own lobes.
inline float layer_share(float alpha, float view_cosine) {
    const SurfaceMaterial material{glm::vec3(0.5f), F0, 1.0f, alpha};
    const BrdfView view =
        prepare_brdf(material, {std::sqrt(1.0f - view_cosine * view_cosine), 0.0f, view_cosine});
    const LayerAlbedo albedo = evaluate_layer_albedo(view.fit, view_cosine);
    return 1.0f - transmit_to_base(material, view.multiple_fresnel, albedo).x;
}

struct Denoised {
    std::vector<glm::vec2> light;  // base, and layer over its share
    std::vector<Met> met;
};

class DenoiseStage {
  public:
    explicit DenoiseStage(const glm::ivec2& size_px) : size_px_(size_px) {
        settings.denoise.mode = DenoiseMode::SVGF_STATIC;
        const float height = 0.5f;
        camera_.right = glm::vec3(height * float(size_px.x) / float(size_px.y), 0.0f, 0.0f);
        camera_.up = glm::vec3(0.0f, height, 0.0f);
        camera_.forward = glm::vec3(0.0f, 0.0f, -1.0f);
        camera_.orthographic = false;
        camera_.position = glm::vec3(0.0f);
    }

    RenderSettings settings;
    float alpha = 0.5f;    // GGX width of all surfaces
    int jitter_count = 1;  // places in a pixel

    void plant(const Defines& defines) { context_.plant(defines); }
    void move_camera(const glm::vec3& by) { camera_.position += by; }

    // The next frame. What it kept is the history of the one after it.
    Denoised render(const SceneOf& scene, const LightOf& light) {
        plan_.denoise = plan_denoise(settings, {}, {});
        jitter_px_ = find_jitter(frame_, jitter_count);
        context_.recorder().begin();
        Denoised result;
        const GBuffer gbuffer = write_surfaces(scene, result.met);
        bind_block();
        const NoisyLight noisy{write_light(light, result.met), {}, nullptr};
        const FrameContext base = context_.frame(size_px_, size_px_);
        const FrameContext frame{base.recorder, base.programs, base.tracer,        base.counters, base.rays,
                                 plan_,         settings,      base.scene_defines, size_px_,      size_px_};
        KeptLight kept;
        const auto previous = history_.of_frame(frame_ - 1);
        const ReflectedLight denoised = denoiser_.record(frame, gbuffer, noisy, previous, kept);
        history_.keep(frame_, kept);
        context_.recorder().end();
        previous_camera_ = camera_;
        previous_jitter_px_ = jitter_px_;
        ++frame_;
        read_light(denoised, result);
        return result;
    }

    std::uint32_t count(std::uint32_t counter) const {
        return context_.counters().download<std::uint32_t>()[counter];
    }

  private:
    glm::vec3 direction(int x, int y) const {
        const float u = 2.0f * (float(x) + 0.5f + jitter_px_.x) / float(size_px_.x) - 1.0f;
        const float v = 1.0f - 2.0f * (float(y) + 0.5f + jitter_px_.y) / float(size_px_.y);
        return glm::normalize(camera_.forward + camera_.right * u + camera_.up * v);
    }

    GBuffer write_surfaces(const SceneOf& scene, std::vector<Met>& met) {
        std::vector<glm::vec4> layers[4];
        shares_.clear();
        for (int y = 0; y < size_px_.y; ++y) {
            for (int x = 0; x < size_px_.x; ++x) {
                const Met m = scene(camera_.position, direction(x, y));
                met.push_back(m);
                shares_.push_back(layer_share(alpha, std::max(1e-3f, -glm::dot(m.normal, direction(x, y)))));
                const glm::vec2 normal = encode_octahedral(m.normal);
                layers[0].emplace_back(m.position, m.lit ? 1e-6f : -1.0f);
                layers[1].emplace_back(normal, normal);
                layers[2].emplace_back(glm::vec3(0.5f), alpha);
                layers[3].emplace_back(F0, 1.0f);
            }
        }
        const Surfaces surfaces = std::make_shared<SurfaceTable>(size_px_, BufferUse::DYNAMIC);
        for (std::size_t layer = 0; layer < 4; ++layer) surfaces->upload(int(layer), layers[layer]);
        context_.recorder().pass("test/write").write_image(0, surfaces->texels());
        return {nullptr, surfaces, std::nullopt};
    }

    ReflectedLight write_light(const LightOf& light, const std::vector<Met>& met) {
        std::vector<glm::vec4> diffuse, specular;
        for (int i = 0; i < int(met.size()); ++i) {
            const glm::vec2 value = light({i % size_px_.x, i / size_px_.x}, met[std::size_t(i)]);
            diffuse.emplace_back(glm::vec3(value.x), 1.0f);
            specular.emplace_back(glm::vec3(value.y * shares_[std::size_t(i)]), 1.0f);
        }
        return {context_.write_picture("test/diffuse", size_px_, GL_RGBA32F, diffuse),
                context_.write_picture("test/specular", size_px_, GL_RGBA32F, specular)};
    }

    void bind_block() {
        FrameBlock block = make_camera_block(camera_, previous_camera_);
        block.frame_size = glm::uvec4(size_px_, frame_, 0u);
        block.frame_full = glm::uvec4(size_px_, 1u, 0u);
        block.frame_jitter = glm::vec4(jitter_px_, previous_jitter_px_);
        block_.upload(0, std::span<const FrameBlock>(&block, 1));
        context_.recorder().bind_frame_block(block_);
    }

    void read_light(const ReflectedLight& light, Denoised& result) const {
        const auto diffuse = light.diffuse->download<glm::vec4>();
        const auto specular = light.specular->download<glm::vec4>();
        for (std::size_t i = 0; i < diffuse.size(); ++i)
            result.light.emplace_back(diffuse[i].x, specular[i].x / shares_[i]);
    }

    PassContext context_;
    glm::ivec2 size_px_;
    CameraRecord camera_{};
    CameraRecord previous_camera_{};
    glm::vec2 jitter_px_{0.0f};
    glm::vec2 previous_jitter_px_{0.0f};
    std::vector<float> shares_;
    FramePlan plan_;
    Denoiser denoiser_;
    History<KeptLight> history_;
    std::uint32_t frame_ = 1;
    Buffer block_{"test/block", sizeof(FrameBlock), BufferUse::DYNAMIC};
};

// A wall at 5 m with a board before it at 2 m and a floor below: edges of depth and of normals.
inline Met meet_room(const glm::vec3& origin, const glm::vec3& direction) {
    const auto at = [&](float t) { return origin + direction * t; };
    const float to_board = (-2.0f - origin.z) / direction.z;
    const glm::vec3 board = at(to_board);
    if (std::abs(board.x) < 0.3f && board.y > -0.3f && board.y < 0.5f) return {board, {0.0f, 0.0f, 1.0f}, 1};
    const float to_wall = (-5.0f - origin.z) / direction.z;
    const float to_floor = direction.y < 0.0f ? (-1.0f - origin.y) / direction.y : 1e9f;
    if (to_floor < to_wall) return {at(to_floor), {0.0f, 1.0f, 0.0f}, 2};
    return {at(to_wall), {0.0f, 0.0f, 1.0f}, 0};
}

inline Met meet_wall(const glm::vec3& origin, const glm::vec3& direction) {
    return {origin + direction * ((-5.0f - origin.z) / direction.z)};
}

// Greatest error relative to what each pixel should have.
inline double greatest_error(const Denoised& found, const std::function<glm::vec2(const Met&)>& expected) {
    double error = 0.0;
    for (std::size_t i = 0; i < found.light.size(); ++i) {
        const glm::vec2 truth = expected(found.met[i]);
        for (int part = 0; part < 2; ++part) {
            const double e = std::abs(double(found.light[i][part]) / truth[part] - 1.0);
            error = std::isfinite(e) ? std::max(error, e) : 1e30;
        }
    }
    return error;
}

}  // namespace tarn::test
