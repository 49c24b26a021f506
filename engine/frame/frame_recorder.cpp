#include "frame/frame_recorder.h"

#include "core/error.h"
#include "gl/fence.h"
#include "shared/interface/bindings.h"

namespace tarn {
namespace {

// All the ways in which later passes look at what a compute shader wrote.
constexpr GLbitfield AFTER_DISPATCH = GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                                      GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT |
                                      GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                                      GL_BUFFER_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void set_culling(Culling culling) {
    if (culling == Culling::NONE) {
        glDisable(GL_CULL_FACE);
        return;
    }
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    // Clip space has +Y down, which turns counter-clockwise into clockwise.
    glFrontFace(culling == Culling::BACK ? GL_CW : GL_CCW);
}

void draw_batches(const std::vector<DrawBatch>& batches) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    for (const DrawBatch& batch : batches) {
        set_culling(batch.culling);
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                    reinterpret_cast<const void*>(batch.offset_bytes), batch.count, 0);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}

// A pass that runs several times a frame is one row.
void add_timing(FrameTimings& timings, const PassTiming& timing) {
    for (PassTiming& pass : timings.passes) {
        if (pass.name == timing.name) {
            pass.ms += timing.ms;
            pass.bytes_read += timing.bytes_read;
            pass.bytes_written += timing.bytes_written;
            return;
        }
    }
    timings.passes.push_back(timing);
}

}  // namespace

// ---- PassRecorder
// ---------------------------------------------------------------------------------------------------

PassRecorder::PassRecorder(FrameRecorder& frame, std::string name)
    : frame_(frame), name_(std::move(name)), group_(name_) {}

PassRecorder::~PassRecorder() = default;

PassRecorder& PassRecorder::read(unsigned unit, const Texture2D& texture) {
    frame_.check_written(texture.id(), true, name_, texture.name());
    return read_unchecked(unit, texture);
}

PassRecorder& PassRecorder::read_unchecked(unsigned unit, const Texture2D& texture) {
    texture.bind(unit);
    bytes_read_ += texture.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::read(unsigned unit, const BufferTexture& texture, const Buffer& buffer) {
    frame_.check_written(buffer.id(), false, name_, buffer.name());
    texture.bind(unit);
    bytes_read_ += buffer.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::read(unsigned unit, const TextureArray& textures) {
    frame_.check_written(textures.id(), true, name_, textures.name());
    return read_unchecked(unit, textures);
}

PassRecorder& PassRecorder::read_unchecked(unsigned unit, const TextureArray& textures) {
    textures.bind(unit);
    bytes_read_ += textures.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::read_unchecked(unsigned unit, const RowBuffer& rows) {
    rows.texture().bind(unit);
    bytes_read_ += rows.buffer().size_bytes();
    return *this;
}

PassRecorder& PassRecorder::read_table(unsigned unit, const RowBuffer& rows) {
    rows.texture().bind(unit);
    return *this;
}

PassRecorder& PassRecorder::bind_constants(const void* bytes, std::size_t size_bytes) {
    frame_.constants_.bind(bytes, size_bytes);
    constants_bytes_ = size_bytes;
    return *this;
}

PassRecorder& PassRecorder::write(const TextureArray& textures) {
    frame_.written_.emplace(true, textures.id());
    bytes_written_ += textures.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::write_image(unsigned unit, const Texture2D& texture) {
    texture.bind_image(unit, GL_WRITE_ONLY);
    frame_.written_.emplace(true, texture.id());
    bytes_written_ += texture.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::write_image(unsigned unit, const RowBuffer& rows) {
    rows.texture().bind_image(unit, GL_WRITE_ONLY);
    frame_.written_.emplace(false, rows.buffer().id());
    bytes_written_ += rows.buffer().size_bytes();
    return *this;
}

PassRecorder& PassRecorder::read_write_image(unsigned unit, const Texture2D& texture) {
    frame_.check_written(texture.id(), true, name_, texture.name());
    texture.bind_image(unit, GL_READ_WRITE);
    bytes_read_ += texture.size_bytes();
    bytes_written_ += texture.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::read_write(unsigned binding, const Rows& rows) {
    const Buffer& buffer = rows->buffer();
    frame_.check_written(buffer.id(), false, name_, buffer.name());
    bytes_read_ += buffer.size_bytes();
    return write(binding, buffer);
}

PassRecorder& PassRecorder::write(unsigned binding, const Buffer& buffer) {
    buffer.bind_storage(binding);
    frame_.written_.emplace(false, buffer.id());
    bytes_written_ += buffer.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::read_on_cpu(const Buffer& buffer) {
    frame_.check_written(buffer.id(), false, name_, buffer.name());
    bytes_read_ += buffer.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::write_on_cpu(const Buffer& buffer) {
    frame_.written_.emplace(false, buffer.id());
    bytes_written_ += buffer.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::write_on_cpu(const Texture2D& texture) {
    frame_.written_.emplace(true, texture.id());
    bytes_written_ += texture.size_bytes();
    return *this;
}

PassRecorder& PassRecorder::count(unsigned binding, const Buffer& buffer) {
    buffer.bind_storage(binding);
    return *this;
}

PassRecorder& PassRecorder::write_target(const Framebuffer& target,
                                         std::initializer_list<const Texture2D*> colours) {
    target.bind();
    for (const Texture2D* colour : colours) {
        frame_.written_.emplace(true, colour->id());
        bytes_written_ += colour->size_bytes();
    }
    return *this;
}

// A block that the shader has and the pass did not fill, or filled with another struct.
void PassRecorder::check_constants(const Program& program) const {
    const std::size_t expected = program.uniform_block_size(BLOCK_PASS);
    const std::size_t rounded = (constants_bytes_ + 15) / 16 * 16;
    if (expected != 0 && expected != rounded) {
        throw Error("pass '{}' gives {} bytes of constants, its shader reads {}", name_, constants_bytes_,
                    expected);
    }
}

void PassRecorder::dispatch(const Program& program, const glm::ivec2& size_px) {
    check_constants(program);
    program.use();
    const glm::ivec2 group_size = program.work_group_size();
    const glm::uvec2 groups((size_px + group_size - 1) / group_size);
    frame_.time_device_work(name_, [&] {
        glDispatchCompute(groups.x, groups.y, 1);
        glMemoryBarrier(AFTER_DISPATCH);
    });
    note_traffic(false);
}

void PassRecorder::draw(const Program& program, const VertexArray& vertices, const Buffer& commands,
                        const std::vector<DrawBatch>& batches) {
    check_constants(program);
    program.use();
    vertices.bind();
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
    frame_.time_device_work(name_, [&] { draw_batches(batches); });
    note_traffic(false);
}

void PassRecorder::run_on_cpu(const std::function<void()>& work) {
    Fence().wait();
    const auto start = std::chrono::steady_clock::now();
    work();
    frame_.timed_.push_back({name_, 0, milliseconds_since(start)});
    note_traffic(true);
}

void PassRecorder::note_traffic(bool is_on_cpu) {
    FrameRecorder::Timed& timed = frame_.timed_.back();
    timed.bytes_read = bytes_read_;
    timed.bytes_written = bytes_written_;
    timed.is_on_cpu = is_on_cpu;
}

// ---- FrameRecorder
// --------------------------------------------------------------------------------------------------

FrameRecorder::FrameRecorder()
    : quirks_(find_driver_quirks(query_device_info())), start_(std::chrono::steady_clock::now()) {}

void FrameRecorder::begin() {
    written_.clear();
    timed_.clear();
    constants_.clear();
    queries_used_ = 0;
    start_ = std::chrono::steady_clock::now();
}

FrameTimings FrameRecorder::end() {
    Fence().wait();
    FrameTimings timings;
    timings.frame_ms = milliseconds_since(start_);
    for (const Timed& timed : timed_) {
        double ms = timed.wall_ms;
        if (ms < 0.0) {
            const std::uint64_t from = queries_[timed.first_query].read_ns();
            const std::uint64_t to = queries_[timed.first_query + 1].read_ns();
            ms = to > from ? double(to - from) * 1e-6 : 0.0;
        }
        add_timing(timings, {timed.name, ms, timed.bytes_read, timed.bytes_written, timed.is_on_cpu});
    }
    return timings;
}

Rows FrameRecorder::take_rows(const std::string& name, std::size_t size_bytes, BufferUse use, GLenum format) {
    const std::string kind = fmt::format("{} {} {} {}", name, size_bytes, int(use), format);
    const Rows rows = row_pool_.take(kind, [&] { return RowBuffer(name, size_bytes, use, format); });
    written_.erase({false, rows->buffer().id()});
    return rows;
}

Picture FrameRecorder::take_picture(const std::string& name, const glm::ivec2& size_px, GLenum format) {
    const std::string kind = fmt::format("{} {} x {} {}", name, size_px.x, size_px.y, format);
    const Picture picture =
        picture_pool_.take(kind, [&] { return Texture2D(name, size_px.x, size_px.y, format); });
    written_.erase({true, picture->id()});
    return picture;
}

void FrameRecorder::bind_frame_block(const Buffer& block) {
    block.bind_uniform(BLOCK_FRAME);
}

void FrameRecorder::check_written(unsigned id, bool is_texture, const std::string& pass,
                                  const std::string& resource) const {
    if (!written_.contains({is_texture, id})) {
        throw Error("pass '{}' reads '{}', which no earlier pass of this frame wrote", pass, resource);
    }
}

void FrameRecorder::time_device_work(const std::string& name, const std::function<void()>& commands) {
    if (quirks_.timestamps_at_submission) {
        Fence().wait();
        const auto start = std::chrono::steady_clock::now();
        commands();
        Fence().wait();
        timed_.push_back({name, 0, milliseconds_since(start)});
        return;
    }
    const std::size_t first = stamp();
    commands();
    stamp();
    timed_.push_back({name, first, -1.0});
}

std::size_t FrameRecorder::stamp() {
    if (queries_used_ == queries_.size()) queries_.emplace_back("frame/timestamp");
    queries_[queries_used_].record();
    return queries_used_++;
}

}  // namespace tarn
