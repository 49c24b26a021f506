// Pictures into files.
#include "tarn/picture.h"

#include "api/guard.h"
#include "core/display.h"
#include "core/version.h"
#include "image_io/image_io.h"
#include "tarn/version.h"

namespace tarn::api {
namespace {

Image to_image(const Picture& picture) {
    Image image;
    image.width = picture.width_px;
    image.height = picture.height_px;
    image.channels = 3;
    image.values = picture.rgb;
    if (image.values.size() != 3 * image.pixel_count())
        throw Error("the picture's size does not fit the number of its values");
    return image;
}

}  // namespace

std::string describe_version() {
    return describe_program();
}

float Picture::auto_exposure_ev() const {
    return guard([&] { return tarn::auto_exposure_ev(to_image(*this)); });
}

void Picture::write_exr(const std::filesystem::path& file) const {
    guard([&] { tarn::write_exr(file, to_image(*this), {{"software", describe_program()}}); });
}

void Picture::write_png(const std::filesystem::path& file, std::optional<float> exposure_ev) const {
    guard([&] {
        const Image image = to_image(*this);
        tarn::write_png(
            file, display_from_radiance(image, exposure_ev ? *exposure_ev : tarn::auto_exposure_ev(image)));
    });
}

}  // namespace tarn::api
