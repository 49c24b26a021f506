// Camera rays over the worker threads: packets of 4 x 2 pixels, in tiles that keep caches warm.
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <array>

#include "core/error.h"
#include "rays/flush_denormals.h"
#include "rays/ray_tracer.h"

namespace tarn {
namespace {

constexpr int PACKET_WIDTH_PX = 4;
constexpr int PACKET_HEIGHT_PX = 2;
// Of a task, in packets.
constexpr int TILE_COLUMNS = 8;
constexpr int TILE_ROWS = 16;

RayRecord make_camera_ray(const CameraRays& rays, const glm::ivec2& pixel) {
    const glm::vec2 place = glm::vec2(pixel) + 0.5f + rays.jitter_px;
    const PixelRay view = camera_ray(rays.camera, place, glm::vec2(rays.size_px));
    return {view.origin, RAY_INFINITY, view.direction, std::uint32_t(pixel.y * rays.size_px.x + pixel.x)};
}

}  // namespace

void RayTracer::trace_packet(std::span<const RayRecord, PACKET> rays, std::size_t count,
                             const CoverageKey& key, std::span<Hit, PACKET> hits) const {
    for (std::size_t i = 0; i < count; ++i)
        hits[i] = trace_closest(rays[i], key, BackFaces::PASS).value_or(Hit{});
}

std::uint64_t RayTracer::trace_camera_rays(const CameraRays& rays, std::span<glm::uvec2> seen,
                                           const CoverageKey& key) const {
    static_assert(PACKET == PACKET_WIDTH_PX * PACKET_HEIGHT_PX);
    const std::size_t pixels = std::size_t(rays.size_px.x) * std::size_t(rays.size_px.y);
    TARN_ASSERT(seen.size() == pixels, "{} answers for {} pixels", seen.size(), pixels);
    const auto trace_at = [&](int column, int row) {
        std::array<RayRecord, PACKET> packet;
        std::array<Hit, PACKET> hits;
        std::array<std::size_t, PACKET> places;
        std::size_t count = 0;
        for (int i = 0; i < int(PACKET); ++i) {
            const glm::ivec2 pixel(column * PACKET_WIDTH_PX + i % PACKET_WIDTH_PX,
                                   row * PACKET_HEIGHT_PX + i / PACKET_WIDTH_PX);
            if (pixel.x >= rays.size_px.x || pixel.y >= rays.size_px.y) continue;
            packet[count] = make_camera_ray(rays, pixel);
            places[count++] = std::size_t(pixel.y) * std::size_t(rays.size_px.x) + std::size_t(pixel.x);
        }
        trace_packet(packet, count, key, hits);
        for (std::size_t i = 0; i < count; ++i) seen[places[i]] = {hits[i].instance, hits[i].primitive};
    };
    const int columns = (rays.size_px.x + PACKET_WIDTH_PX - 1) / PACKET_WIDTH_PX;
    const int rows = (rays.size_px.y + PACKET_HEIGHT_PX - 1) / PACKET_HEIGHT_PX;
    tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, TILE_ROWS, 0, columns, TILE_COLUMNS),
                      [&](const tbb::blocked_range2d<int>& tile) {
                          const FlushDenormals flush;
                          for (int row = tile.rows().begin(); row != tile.rows().end(); ++row) {
                              for (int column = tile.cols().begin(); column != tile.cols().end(); ++column)
                                  trace_at(column, row);
                          }
                      });
    return pixels;
}

}  // namespace tarn
