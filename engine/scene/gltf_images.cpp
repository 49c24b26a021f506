// Decodes PNG and JPEG with stb_image, after checking what the picture claims about itself.
#include "scene/gltf_images.h"

#include <stb_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "core/error.h"
#include "scene/gltf_uri.h"

namespace tarn {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t MAX_IMAGE_BYTES = 1ull << 30;
constexpr int MAX_SIDE_PX = 16384;
// Deflate shrinks by at most 1032, and a pixel has at least one bit; a JPEG block of 64 pixels costs at least
// a bit.
constexpr std::uint64_t PNG_PIXELS_PER_BYTE = 1032 * 8;
constexpr std::uint64_t JPEG_PIXELS_PER_BYTE = 64 * 8;

struct FreePixels {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};

// IEC 61966-2-1.
double linear_from_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::uint16_t to_u16(double value) {
    return std::uint16_t(std::lround(value * 65535.0));
}

// Encoded value to 16-bit linear, for all encoded values of `Texel`.
template <class Texel>
std::vector<std::uint16_t> decoding_table(TexelEncoding encoding) {
    constexpr std::size_t COUNT = std::size_t(std::numeric_limits<Texel>::max()) + 1;
    std::vector<std::uint16_t> table(COUNT);
    for (std::size_t i = 0; i < COUNT; ++i) {
        const double value = double(i) / double(COUNT - 1);
        table[i] = to_u16(encoding == TexelEncoding::SRGB ? linear_from_srgb(value) : value);
    }
    return table;
}

template <class Texel>
std::vector<glm::u16vec4> to_linear(const Texel* pixels, std::size_t count, TexelEncoding encoding) {
    const std::vector<std::uint16_t> color = decoding_table<Texel>(encoding);
    const std::vector<std::uint16_t> alpha = decoding_table<Texel>(TexelEncoding::LINEAR);
    std::vector<glm::u16vec4> texels(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Texel* p = pixels + 4 * i;
        texels[i] = {color[p[0]], color[p[1]], color[p[2]], alpha[p[3]]};
    }
    return texels;
}

bool is_png(Bytes bytes) {
    constexpr std::array<std::uint8_t, 8> SIGNATURE = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() > SIGNATURE.size() && std::equal(SIGNATURE.begin(), SIGNATURE.end(), bytes.begin());
}

bool is_jpeg(Bytes bytes) {
    return bytes.size() > 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

bool starts_with(Bytes bytes, std::size_t offset, std::string_view text) {
    return bytes.size() >= offset + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + long(offset));
}

// The name of a format that only an extension brings into glTF; null for any other.
const char* extension_format(Bytes bytes) {
    if (starts_with(bytes, 1, "KTX ")) return "KTX";
    if (starts_with(bytes, 0, "RIFF") && starts_with(bytes, 8, "WEBP")) return "WebP";
    if (starts_with(bytes, 0, "DDS ")) return "DDS";
    return nullptr;
}

void check_claimed_size(Bytes bytes, int width, int height) {
    if (width < 1 || height < 1 || width > MAX_SIDE_PX || height > MAX_SIDE_PX) {
        throw Error("is {}x{} pixels, the limit is {}x{}", width, height, MAX_SIDE_PX, MAX_SIDE_PX);
    }
    const std::uint64_t pixels_per_byte = is_png(bytes) ? PNG_PIXELS_PER_BYTE : JPEG_PIXELS_PER_BYTE;
    if (std::uint64_t(width) * std::uint64_t(height) > pixels_per_byte * bytes.size()) {
        throw Error("claims {}x{} pixels, which {} bytes cannot hold", width, height, bytes.size());
    }
}

TextureImage decode_image(Bytes bytes, TexelEncoding encoding) {
    if (bytes.size() > MAX_IMAGE_BYTES)
        throw Error("has {} bytes, the limit is {}", bytes.size(), MAX_IMAGE_BYTES);
    if (!is_png(bytes) && !is_jpeg(bytes)) throw Error("is neither PNG nor JPEG ({} bytes)", bytes.size());
    const int size = int(bytes.size());
    TextureImage image;
    int channels = 0;
    if (stbi_info_from_memory(bytes.data(), size, &image.width, &image.height, &channels) == 0) {
        throw Error("cannot be decoded: {}", stbi_failure_reason());
    }
    check_claimed_size(bytes, image.width, image.height);
    const bool is_16_bit = stbi_is_16_bit_from_memory(bytes.data(), size) != 0;
    std::unique_ptr<void, FreePixels> pixels;
    if (is_16_bit) {
        pixels.reset(stbi_load_16_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 4));
    } else {
        pixels.reset(stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 4));
    }
    if (!pixels) throw Error("cannot be decoded: {}", stbi_failure_reason());
    const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
    image.texels = is_16_bit ? to_linear(static_cast<const std::uint16_t*>(pixels.get()), count, encoding)
                             : to_linear(static_cast<const std::uint8_t*>(pixels.get()), count, encoding);
    return image;
}

// The picture file itself, empty where there is none; `storage` keeps what is not in a buffer.
Bytes image_bytes(const GltfDocument& document, const tinygltf::Image& image,
                  std::vector<std::uint8_t>& storage) {
    if (image.bufferView >= 0) {
        const tinygltf::BufferView& view = document.model.bufferViews[std::size_t(image.bufferView)];
        const tinygltf::Buffer& buffer = document.model.buffers[std::size_t(view.buffer)];
        if (buffer.data.empty()) return {};
        return Bytes(buffer.data).subspan(view.byteOffset, view.byteLength);
    }
    const std::filesystem::path folder = document.path.parent_path();
    if (image.uri.empty() || is_missing_file(image.uri, folder)) return {};
    storage = load_uri(image.uri, folder, MAX_IMAGE_BYTES);
    return storage;
}

}  // namespace

std::optional<TextureImage> load_gltf_image(GltfDocument& document, int index, TexelEncoding encoding) {
    const tinygltf::Image& source = document.model.images[std::size_t(index)];
    const bool is_file = !source.uri.empty() && !is_data_uri(source.uri);
    const std::string label =
        is_file ? fmt::format("images[{}] ({})", index, source.uri) : fmt::format("images[{}]", index);
    try {
        std::vector<std::uint8_t> storage;
        const Bytes bytes = image_bytes(document, source, storage);
        if (bytes.empty()) {
            document.warn(label + " is not there, it is ignored");
            return std::nullopt;
        }
        if (const char* format = extension_format(bytes)) {
            document.warn(
                fmt::format("{} is a {} image, which is not supported: it is ignored", label, format));
            return std::nullopt;
        }
        TextureImage image = decode_image(bytes, encoding);
        image.name = !source.name.empty() ? source.name
                     : is_file            ? source.uri
                                          : fmt::format("image {}", index);
        return image;
    } catch (const Error& error) {
        throw Error("{} {}", label, error.what());
    }
}

}  // namespace tarn
