// The table of texel formats.
#include "gl/pixel_format.h"

#include "core/error.h"

namespace tarn {
namespace {

#define TARN_FORMAT(NAME, FORMAT, TYPE, BYTES, CHANNELS)          \
    PixelFormat {                                                 \
        GL_##NAME, #NAME, GL_##FORMAT, GL_##TYPE, BYTES, CHANNELS \
    }

constexpr PixelFormat FORMATS[] = {
    TARN_FORMAT(R8, RED, UNSIGNED_BYTE, 1, 1),
    TARN_FORMAT(RG8, RG, UNSIGNED_BYTE, 2, 2),
    TARN_FORMAT(RGBA8, RGBA, UNSIGNED_BYTE, 4, 4),
    TARN_FORMAT(SRGB8_ALPHA8, RGBA, UNSIGNED_BYTE, 4, 4),
    TARN_FORMAT(RGB10_A2, RGBA, UNSIGNED_INT_2_10_10_10_REV, 4, 4),
    TARN_FORMAT(R11F_G11F_B10F, RGB, UNSIGNED_INT_10F_11F_11F_REV, 4, 3),
    TARN_FORMAT(R16, RED, UNSIGNED_SHORT, 2, 1),
    TARN_FORMAT(RGBA16, RGBA, UNSIGNED_SHORT, 8, 4),
    TARN_FORMAT(R16F, RED, HALF_FLOAT, 2, 1),
    TARN_FORMAT(RG16F, RG, HALF_FLOAT, 4, 2),
    TARN_FORMAT(RGBA16F, RGBA, HALF_FLOAT, 8, 4),
    TARN_FORMAT(R32F, RED, FLOAT, 4, 1),
    TARN_FORMAT(RG32F, RG, FLOAT, 8, 2),
    TARN_FORMAT(RGB32F, RGB, FLOAT, 12, 3),
    TARN_FORMAT(RGBA32F, RGBA, FLOAT, 16, 4),
    TARN_FORMAT(R8UI, RED_INTEGER, UNSIGNED_BYTE, 1, 1),
    TARN_FORMAT(R16UI, RED_INTEGER, UNSIGNED_SHORT, 2, 1),
    TARN_FORMAT(R32UI, RED_INTEGER, UNSIGNED_INT, 4, 1),
    TARN_FORMAT(RG32UI, RG_INTEGER, UNSIGNED_INT, 8, 2),
    TARN_FORMAT(RGB32UI, RGB_INTEGER, UNSIGNED_INT, 12, 3),
    TARN_FORMAT(RGBA32UI, RGBA_INTEGER, UNSIGNED_INT, 16, 4),
    TARN_FORMAT(R32I, RED_INTEGER, INT, 4, 1),
    TARN_FORMAT(RG32I, RG_INTEGER, INT, 8, 2),
    TARN_FORMAT(RGBA32I, RGBA_INTEGER, INT, 16, 4),
    TARN_FORMAT(DEPTH_COMPONENT32F, DEPTH_COMPONENT, FLOAT, 4, 1),
};
#undef TARN_FORMAT

}  // namespace

bool PixelFormat::is_integer() const {
    return format == GL_RED_INTEGER || format == GL_RG_INTEGER || format == GL_RGB_INTEGER ||
           format == GL_RGBA_INTEGER;
}

const PixelFormat& get_pixel_format(GLenum internal_format) {
    for (const PixelFormat& row : FORMATS)
        if (row.internal_format == internal_format) return row;
    throw Error("texture format 0x{:04x} is not in the table of texel formats", internal_format);
}

}  // namespace tarn
