// The file of a blue noise mask, as tools/blue_noise writes it and the loader reads it.
//
// A header of eight words, then the values; all little-endian. The values of a texel stand together: one
// 16-bit number in units of 2^-16 for each channel. Texels follow in x, then y, then slices.
#pragma once

#include <cstdint>
#include <span>

namespace tarn {

inline constexpr const char* BLUE_NOISE_FILE = "blue_noise.bin";
inline constexpr int MASK_CHANNELS = 2;

inline constexpr std::uint32_t MASK_MAGIC[] = {0x4e524154u, 0x4b53414du};  // "TARNMASK"
inline constexpr std::uint32_t MASK_VERSION = 1;

// Places of the header's words.
enum MaskWord {
    MASK_WORD_MAGIC = 0,  // and 1
    MASK_WORD_VERSION = 2,
    MASK_WORD_WIDTH = 3,
    MASK_WORD_HEIGHT = 4,
    MASK_WORD_SLICES = 5,
    MASK_WORD_CHANNELS = 6,
    MASK_WORD_CHECKSUM = 7,  // of the bytes behind the header
    MASK_WORD_COUNT = 8,
};
inline constexpr std::size_t MASK_HEADER_BYTES = 4 * MASK_WORD_COUNT;

// FNV-1a with 32 bits: finds a damaged file, not a forged one.
inline std::uint32_t compute_mask_checksum(std::span<const unsigned char> bytes) {
    std::uint32_t sum = 2166136261u;
    for (const unsigned char byte : bytes) sum = (sum ^ byte) * 16777619u;
    return sum;
}

}  // namespace tarn
