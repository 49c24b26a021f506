// Radiance .hdr and PNG, by the stb libraries, and the choice of the reader of radiance.
#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "core/error.h"
#include "image_io/file.h"
#include "image_io/formats.h"
#include "image_io/image_io.h"

namespace tarn {
namespace {

struct StbDeleter {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};

// The header is read first, so that a lie about the size costs no memory.
void check_header(const std::filesystem::path& path, const std::vector<unsigned char>& bytes,
                  const char* format) {
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max())) {
        throw Error("{}: holds {} bytes, the limit is 2 GiB", path.string(), bytes.size());
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels)) {
        throw Error("{}: cannot read as {}: {}", path.string(), format, stbi_failure_reason());
    }
    check_picture_size(path, width, height);
    // Run lengths and deflate shrink at most by about a thousand.
    const std::int64_t claimed_bytes = std::int64_t(width) * height;
    if (claimed_bytes / 2048 > std::int64_t(bytes.size())) {
        throw Error("{}: the header claims {} x {} pixels, the file holds {} bytes", path.string(), width,
                    height, bytes.size());
    }
}

template <class T, class ToFloat>
Image take_pixels(T* pixels, int width, int height, ToFloat to_float) {
    const std::unique_ptr<T, StbDeleter> owner(pixels);
    Image image(width, height, 3);
    std::transform(pixels, pixels + image.values.size(), image.values.begin(), to_float);
    return image;
}

bool starts_with(const std::vector<unsigned char>& bytes, const std::string& magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

Image read_hdr(const std::filesystem::path& path, const std::vector<unsigned char>& bytes) {
    check_header(path, bytes, "Radiance HDR");
    int width = 0;
    int height = 0;
    int channels = 0;
    float* pixels = stbi_loadf_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels, 3);
    if (!pixels) throw Error("{}: cannot read as Radiance HDR: {}", path.string(), stbi_failure_reason());
    return take_pixels(pixels, width, height, [](float value) { return value; });
}

unsigned char to_byte(float value) {
    // Written so that NaN becomes 0.
    const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    return static_cast<unsigned char>(std::lround(clamped * 255.0f));
}

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

struct PngSink {
    std::unique_ptr<std::FILE, FileCloser> file;
    bool complete = true;
};

void write_bytes(void* context, void* data, int size) {
    PngSink& sink = *static_cast<PngSink*>(context);
    sink.complete =
        sink.complete && std::fwrite(data, 1, std::size_t(size), sink.file.get()) == std::size_t(size);
}

}  // namespace

void check_readable(const std::filesystem::path& path) {
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (status.type() == std::filesystem::file_type::not_found)
        throw Error("{}: no such file", path.string());
    if (std::filesystem::is_directory(status)) throw Error("{}: is a folder, not a file", path.string());
}

Image read_radiance(const std::filesystem::path& path) {
    check_readable(path);
    const std::vector<unsigned char> bytes = load_file(path);
    if (starts_with(bytes, "\x76\x2f\x31\x01")) return read_exr_radiance(path);
    if (starts_with(bytes, "#?")) return read_hdr(path, bytes);
    throw Error("{}: is neither an OpenEXR nor a Radiance HDR file", path.string());
}

void write_png(const std::filesystem::path& path, const Image& display_rgb) {
    if (display_rgb.channels != 3) {
        throw Error("{}: the picture has {} channels, 3 are needed", path.string(), display_rgb.channels);
    }
    check_picture_size(path, display_rgb.width, display_rgb.height);
    std::vector<unsigned char> bytes(display_rgb.values.size());
    std::transform(display_rgb.values.begin(), display_rgb.values.end(), bytes.begin(), to_byte);
    write_whole(path, [&](const std::string& name) {
        PngSink sink{std::unique_ptr<std::FILE, FileCloser>(std::fopen(name.c_str(), "wb"))};
        if (!sink.file) throw Error("{}: cannot write: {}", path.string(), std::strerror(errno));
        const int stride = 3 * display_rgb.width;
        const int encoded = stbi_write_png_to_func(write_bytes, &sink, display_rgb.width, display_rgb.height,
                                                   3, bytes.data(), stride);
        const bool flushed = std::fflush(sink.file.get()) == 0;
        if (!encoded || !sink.complete || !flushed) {
            throw Error("{}: cannot write: the disk took only a part of the picture", path.string());
        }
    });
}

Image read_png(const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = load_file(path);
    if (!starts_with(bytes, "\x89PNG")) throw Error("{}: is not a PNG file", path.string());
    check_header(path, bytes, "PNG");
    int width = 0;
    int height = 0;
    int channels = 0;
    unsigned char* pixels =
        stbi_load_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels, 3);
    if (!pixels) throw Error("{}: cannot read as PNG: {}", path.string(), stbi_failure_reason());
    return take_pixels(pixels, width, height, [](unsigned char value) { return float(value) / 255.0f; });
}

}  // namespace tarn
