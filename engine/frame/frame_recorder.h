// Records one frame, pass by pass: binds, labels, times, issues the barriers, and checks that what a pass
// reads was written earlier in this frame.
//
//     frame.pass("direct/shade").read(14, reservoirs).write_image(0, radiance).dispatch(program, size_px);
//
// Tables that the CPU filled are read as such; only a History<T> (frame/history.h) looks back to the frame
// before.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "frame/constants_buffer.h"
#include "frame/history.h"
#include "frame/pool.h"
#include "frame/timings.h"
#include "gl/buffer.h"
#include "gl/debug_output.h"
#include "gl/driver_quirks.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/query.h"
#include "gl/row_buffer.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace tarn {

class FrameRecorder;

// Which triangles are left out by their side; a mirroring transform turns triangles inside out.
enum class Culling { NONE, BACK, BACK_MIRRORED };

// Consecutive commands of an indirect draw that share their state.
struct DrawBatch {
    Culling culling = Culling::NONE;
    std::size_t offset_bytes = 0;  // of the first command
    int count = 0;
};

// Values of a frame, in pooled memory.
using Rows = std::shared_ptr<RowBuffer>;
using Picture = std::shared_ptr<Texture2D>;

// A pass while it is being described. Lives until the end of the statement that records it.
class PassRecorder {
  public:
    PassRecorder(FrameRecorder& frame, std::string name);
    ~PassRecorder();
    PassRecorder(const PassRecorder&) = delete;
    PassRecorder& operator=(const PassRecorder&) = delete;

    // Reads through texture unit `unit` what an earlier pass of this frame wrote.
    PassRecorder& read(unsigned unit, const Texture2D& texture);
    // The same through a buffer texture; `buffer` is the memory behind it.
    PassRecorder& read(unsigned unit, const BufferTexture& texture, const Buffer& buffer);
    PassRecorder& read(unsigned unit, const TextureArray& textures);
    PassRecorder& read(unsigned unit, const RowBuffer& rows) {
        return read(unit, rows.texture(), rows.buffer());
    }
    PassRecorder& read(unsigned unit, const Rows& rows) { return read(unit, *rows); }
    PassRecorder& read(unsigned unit, const Picture& picture) { return read(unit, *picture); }
    // What the last frame kept: `part` of `value`.
    template <class T>
    PassRecorder& read(unsigned unit, const Previous<T>& /*value*/, const TextureArray& part) {
        return read_unchecked(unit, part);
    }
    template <class T>
    PassRecorder& read(unsigned unit, const Previous<T>& /*value*/, const RowBuffer& part) {
        return read_unchecked(unit, part);
    }
    template <class T>
    PassRecorder& read(unsigned unit, const Previous<T>& /*value*/, const Rows& part) {
        return read_unchecked(unit, *part);
    }
    template <class T>
    PassRecorder& read(unsigned unit, const Previous<T>& /*value*/, const Picture& part) {
        return read_unchecked(unit, *part);
    }
    // A table that the CPU filled. What a pass reads of it is no traffic that could be told.
    PassRecorder& read_table(unsigned unit, const RowBuffer& rows);
    // The pass's own constants (shared/interface/constants), a copy of which it gets.
    template <class T>
    PassRecorder& constants(const T& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        return bind_constants(&values, sizeof(T));
    }
    // Writes through image unit `unit`.
    PassRecorder& write_image(unsigned unit, const Texture2D& texture);
    PassRecorder& write_image(unsigned unit, const RowBuffer& rows);
    // Reads what an earlier pass wrote and writes over it.
    PassRecorder& read_write_image(unsigned unit, const Texture2D& texture);
    // Says that the layers of `textures`, bound one by one, are all written.
    PassRecorder& write(const TextureArray& textures);
    // Writes as storage block `binding`.
    PassRecorder& write(unsigned binding, const Buffer& buffer);
    PassRecorder& write(unsigned binding, const RowBuffer& rows) { return write(binding, rows.buffer()); }
    PassRecorder& write(unsigned binding, const Rows& rows) { return write(binding, rows->buffer()); }
    // The same where the pass keeps some of what an earlier pass wrote there.
    PassRecorder& read_write(unsigned binding, const Rows& rows);
    // Reads by the CPU, through the buffer's mapping.
    PassRecorder& read_on_cpu(const Buffer& buffer);
    // Writes by the CPU, through the buffer's mapping.
    PassRecorder& write_on_cpu(const Buffer& buffer);
    // The same of a whole texture, by uploading it.
    PassRecorder& write_on_cpu(const Texture2D& texture);
    // Adds to counters in storage block `binding`; they need not have been written in this frame.
    PassRecorder& count(unsigned binding, const Buffer& buffer);
    // Draws into `target`, whose colours the pass so writes.
    PassRecorder& write_target(const Framebuffer& target, std::initializer_list<const Texture2D*> colours);

    // Runs a compute shader once per pixel.
    void dispatch(const Program& program, const glm::ivec2& size_px);
    // Draws the batches of indirect `commands` (as glMultiDrawElementsIndirect reads them), indexed by
    // `vertices`. Depth is reversed: the greater one is nearer. Row 0 of the target is on top.
    void draw(const Program& program, const VertexArray& vertices, const Buffer& commands,
              const std::vector<DrawBatch>& batches);
    // Runs work of the CPU over buffers that it shares with GL: waits for the device before, and is timed
    // alone.
    void run_on_cpu(const std::function<void()>& work);

  private:
    PassRecorder& read_unchecked(unsigned unit, const Texture2D& texture);
    PassRecorder& read_unchecked(unsigned unit, const TextureArray& textures);
    PassRecorder& read_unchecked(unsigned unit, const RowBuffer& rows);
    PassRecorder& bind_constants(const void* bytes, std::size_t size_bytes);
    void check_constants(const Program& program) const;
    void note_traffic(bool is_on_cpu);

    FrameRecorder& frame_;
    std::size_t constants_bytes_ = 0;
    std::string name_;
    DebugGroup group_;
    std::size_t bytes_read_ = 0;
    std::size_t bytes_written_ = 0;
};

class FrameRecorder {
  public:
    FrameRecorder();

    // Starts a frame: forgets what was written, restarts the clock.
    void begin();
    // Waits for the device and returns what the frame cost.
    FrameTimings end();

    PassRecorder pass(std::string name) { return PassRecorder(*this, std::move(name)); }

    // Memory for a value of this frame: nothing is written there yet. Errors: RowBuffer, Texture2D.
    Rows take_rows(const std::string& name, std::size_t size_bytes, BufferUse use,
                   GLenum format = GL_RGBA32UI);
    Picture take_picture(const std::string& name, const glm::ivec2& size_px, GLenum format);

    const DriverQuirks& quirks() const { return quirks_; }

    // Binds a table for all passes of the frame.
    void bind_table(unsigned unit, const RowBuffer& rows) { rows.texture().bind(unit); }
    // Binds the constants of the frame itself.
    void bind_frame_block(const Buffer& block);

  private:
    friend class PassRecorder;

    struct Timed {
        std::string name;
        std::size_t first_query = 0;  // begin and end in queries_, where the device's clock is used
        double wall_ms = -1.0;        // >= 0: by the wall clock
        std::size_t bytes_read = 0;
        std::size_t bytes_written = 0;
        bool is_on_cpu = false;
    };

    void check_written(unsigned id, bool is_texture, const std::string& pass,
                       const std::string& resource) const;
    // Issues the commands of pass `name` and times them on the device.
    void time_device_work(const std::string& name, const std::function<void()>& commands);
    std::size_t stamp();

    Pool<RowBuffer> row_pool_;
    Pool<Texture2D> picture_pool_;
    ConstantsBuffer constants_;
    DriverQuirks quirks_;
    std::set<std::pair<bool, unsigned>> written_;  // (is texture, GL name)
    std::vector<TimestampQuery> queries_;
    std::size_t queries_used_ = 0;
    std::vector<Timed> timed_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace tarn
