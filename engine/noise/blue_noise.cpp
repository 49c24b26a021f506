// Finds and reads the file of the blue noise mask.
#include "noise/blue_noise.h"

#include <span>

#include "core/data_files.h"
#include "core/error.h"
#include "image_io/file.h"
#include "noise/mask_format.h"

namespace tarn {
namespace {

using Bytes = std::span<const unsigned char>;

constexpr std::size_t FILE_BYTES =
    MASK_HEADER_BYTES + std::size_t(BLUE_NOISE_TEXEL_COUNT) * MASK_CHANNELS * sizeof(std::uint16_t);

// The little-endian word `index` of `bytes`.
std::uint32_t read_word(Bytes bytes, std::size_t index) {
    const unsigned char* at = bytes.data() + 4 * index;
    return at[0] | std::uint32_t(at[1]) << 8u | std::uint32_t(at[2]) << 16u | std::uint32_t(at[3]) << 24u;
}

void check_header(const std::string& name, Bytes bytes) {
    if (bytes.size() < MASK_HEADER_BYTES) {
        throw Error("{}: the file has {} bytes, the header of a blue noise mask has {}", name, bytes.size(),
                    MASK_HEADER_BYTES);
    }
    if (read_word(bytes, MASK_WORD_MAGIC) != MASK_MAGIC[0] ||
        read_word(bytes, MASK_WORD_MAGIC + 1) != MASK_MAGIC[1]) {
        throw Error("{}: is not a blue noise mask: it does not begin with TARNMASK", name);
    }
    if (const std::uint32_t version = read_word(bytes, MASK_WORD_VERSION); version != MASK_VERSION) {
        throw Error("{}: the mask's version is {}, this program reads {}", name, version, MASK_VERSION);
    }
    const std::uint32_t width = read_word(bytes, MASK_WORD_WIDTH),
                        height = read_word(bytes, MASK_WORD_HEIGHT);
    const std::uint32_t slices = read_word(bytes, MASK_WORD_SLICES);
    const std::uint32_t channels = read_word(bytes, MASK_WORD_CHANNELS);
    if (width != BLUE_NOISE_SIZE || height != BLUE_NOISE_SIZE || slices != BLUE_NOISE_SLICES ||
        channels != MASK_CHANNELS) {
        throw Error("{}: the mask is {} x {} x {} with {} channels, {} x {} x {} with {} are needed", name,
                    width, height, slices, channels, BLUE_NOISE_SIZE, BLUE_NOISE_SIZE, BLUE_NOISE_SLICES,
                    MASK_CHANNELS);
    }
}

}  // namespace

BlueNoiseMask load_blue_noise() {
    constexpr DataFolder NOISE = {"noise", "TARN_NOISE_DIR", TARN_NOISE_DIR};
    return load_blue_noise(locate_data_file(NOISE, BLUE_NOISE_FILE));
}

BlueNoiseMask load_blue_noise(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = load_file(file);
    check_header(file.string(), bytes);
    if (bytes.size() != FILE_BYTES) {
        throw Error("{}: the file has {} bytes, a mask of this size has {}", file.string(), bytes.size(),
                    FILE_BYTES);
    }
    const Bytes values = Bytes(bytes).subspan(MASK_HEADER_BYTES);
    const std::uint32_t expected = read_word(bytes, MASK_WORD_CHECKSUM), sum = compute_mask_checksum(values);
    if (sum != expected) {
        throw Error("{}: the mask is damaged: its checksum is {:08x}, the header says {:08x}", file.string(),
                    sum, expected);
    }
    BlueNoiseMask mask;
    mask.texels.reserve(BLUE_NOISE_TEXEL_COUNT);
    // Two channels of 16 bits are one word.
    for (uint texel = 0; texel < BLUE_NOISE_TEXEL_COUNT; ++texel)
        mask.texels.push_back(read_word(values, texel));
    return mask;
}

}  // namespace tarn
