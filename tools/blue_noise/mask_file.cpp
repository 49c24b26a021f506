// Puts ranks into the file format of blue noise masks.
#include "blue_noise/mask_file.h"

#include "core/error.h"
#include "noise/mask_format.h"

namespace tarn::noise {
namespace {

using Bytes = std::vector<unsigned char>;

void append(Bytes& bytes, std::uint32_t value, int byte_count) {
    for (int i = 0; i < byte_count; ++i) bytes.push_back((value >> (8 * i)) & 0xffu);
}

}  // namespace

Bytes encode_mask(const MaskSize& size, const Ranks& first, const Ranks& second) {
    TARN_ASSERT(first.size() == second.size(), "{} and {} ranks", first.size(), second.size());
    const std::uint32_t unit = 65536u / std::uint32_t(size.width * size.height);
    Bytes values;
    for (std::size_t i = 0; i < first.size(); ++i) {
        append(values, first[i] * unit, 2);
        append(values, second[i] * unit, 2);
    }
    Bytes bytes;
    const std::uint32_t words[MASK_WORD_COUNT] = {MASK_MAGIC[0],
                                                  MASK_MAGIC[1],
                                                  MASK_VERSION,
                                                  std::uint32_t(size.width),
                                                  std::uint32_t(size.height),
                                                  std::uint32_t(size.slices),
                                                  MASK_CHANNELS,
                                                  compute_mask_checksum(values)};
    for (const std::uint32_t word : words) append(bytes, word, 4);
    bytes.insert(bytes.end(), values.begin(), values.end());
    return bytes;
}

Bytes make_mask_file(const MaskSize& size, std::uint32_t seed) {
    const Ranks first = make_blue_noise(size, seed);
    return encode_mask(size, first, make_second_coordinate(size, first, seed + 1u));
}

}  // namespace tarn::noise
