// LDR-FLIP as a colour pipeline and a feature pipeline over separable filters; HDR-FLIP as its maximum over
// exposures.
#include "metrics/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/display.h"
#include "metrics/convolve.h"
#include "metrics/flip_colour.h"
#include "metrics/image_error.h"
#include "shared/math/colour.h"

namespace tarn {
namespace {

// Contrast sensitivity as a sum of Gaussians in the spatial domain (HPG 2020, table 1): a sqrt(pi / b)
// e^(-pi^2 x^2 / b).
struct Gaussian {
    double a;
    double b;
};
constexpr Gaussian ACHROMATIC = {1.0, 0.0047};
constexpr Gaussian RED_GREEN = {1.0, 0.0053};
constexpr Gaussian BLUE_YELLOW[2] = {{34.1, 0.04}, {13.5, 0.025}};

constexpr float COLOUR_EXPONENT = 0.7f;   // q_c
constexpr float FEATURE_EXPONENT = 0.5f;  // q_f
constexpr float KNEE_ERROR = 0.4f;        // p_c: errors below this share of the largest ...
constexpr float KNEE_VALUE = 0.95f;       // p_t: ... take this share of the range
constexpr double FEATURE_WIDTH_DEGREES = 0.082;

// All kernels for one viewing distance.
struct Filters {
    Kernel achromatic;
    Kernel red_green;
    Kernel blue_yellow[2];
    float blue_yellow_share[2];
    Kernel smooth;
    Kernel edge;
    Kernel point;

    explicit Filters(double pixels_per_degree) {
        const double widest = std::max({ACHROMATIC.b, RED_GREEN.b, BLUE_YELLOW[0].b, BLUE_YELLOW[1].b});
        const int radius = int(std::ceil(
            3.0 * std::sqrt(widest / (2.0 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
        const auto kernel = [&](const Gaussian& g) {
            return gaussian_kernel(deviation_px(g, pixels_per_degree), radius);
        };
        achromatic = kernel(ACHROMATIC);
        red_green = kernel(RED_GREEN);
        double masses[2];
        for (int i = 0; i < 2; ++i) {
            blue_yellow[i] = kernel(BLUE_YELLOW[i]);
            masses[i] = mass(BLUE_YELLOW[i], pixels_per_degree, radius);
        }
        for (int i = 0; i < 2; ++i) blue_yellow_share[i] = float(masses[i] / (masses[0] + masses[1]));
        make_feature_kernels(0.5 * FEATURE_WIDTH_DEGREES * pixels_per_degree);
    }

  private:
    static double deviation_px(const Gaussian& g, double pixels_per_degree) {
        return std::sqrt(g.b / (2.0 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree;
    }

    // The sum of the two-dimensional samples, before they are normalized.
    static double mass(const Gaussian& g, double pixels_per_degree, int radius) {
        const double deviation = deviation_px(g, pixels_per_degree);
        double sum = 0;
        for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (deviation * deviation));
        return g.a * std::sqrt(std::numbers::pi / g.b) * sum * sum;
    }

    // Positive weights of a detector sum to 1, negative ones to -1.
    static Kernel normalized_detector(const std::vector<double>& weights) {
        double positive = 0;
        double negative = 0;
        for (const double weight : weights) (weight > 0.0 ? positive : negative) += std::abs(weight);
        Kernel kernel;
        for (const double weight : weights)
            kernel.push_back(float(weight / (weight > 0.0 ? positive : negative)));
        return kernel;
    }

    void make_feature_kernels(double deviation) {
        const int radius = int(std::ceil(3.0 * deviation));
        std::vector<double> first;
        std::vector<double> second;
        for (int x = -radius; x <= radius; ++x) {
            const double t = x / deviation;
            first.push_back(-x * std::exp(-0.5 * t * t));
            second.push_back((t * t - 1.0) * std::exp(-0.5 * t * t));
        }
        smooth = gaussian_kernel(deviation, radius);
        edge = normalized_detector(first);
        point = normalized_detector(second);
    }
};

struct Opponents {
    Plane y;
    Plane cx;
    Plane cz;

    Opponents(int width, int height) : y(width, height), cx(width, height), cz(width, height) {}
};

// `rgb` is linear and within [0, 1].
Opponents opponents_of(const Image& rgb) {
    Opponents planes(rgb.width, rgb.height);
    for (std::size_t i = 0; i < rgb.pixel_count(); ++i) {
        const float* pixel = &rgb.values[3 * i];
        const Colour colour = ycxcz_from_linear_rgb({pixel[0], pixel[1], pixel[2]});
        planes.y.values[i] = colour.x;
        planes.cx.values[i] = colour.y;
        planes.cz.values[i] = colour.z;
    }
    return planes;
}

// What the eye resolves of an image at this distance, as Hunt-adjusted CIELAB.
std::vector<Colour> perceived_colours(const Opponents& image, const Filters& filters) {
    const Plane y = correlate(image.y, filters.achromatic, filters.achromatic);
    const Plane cx = correlate(image.cx, filters.red_green, filters.red_green);
    const Plane wide = correlate(image.cz, filters.blue_yellow[0], filters.blue_yellow[0]);
    const Plane narrow = correlate(image.cz, filters.blue_yellow[1], filters.blue_yellow[1]);
    std::vector<Colour> colours(y.values.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const float cz =
            filters.blue_yellow_share[0] * wide.values[i] + filters.blue_yellow_share[1] * narrow.values[i];
        Colour rgb = linear_rgb_from_ycxcz({y.values[i], cx.values[i], cz});
        rgb = {std::clamp(rgb.x, 0.0f, 1.0f), std::clamp(rgb.y, 0.0f, 1.0f), std::clamp(rgb.z, 0.0f, 1.0f)};
        colours[i] = hunt_lab_from_linear_rgb(rgb);
    }
    return colours;
}

// Length of the gradient (edges) or of the second derivatives (points) of luminance in [0, 1].
Plane feature_strength(const Plane& luminance, const Kernel& detector, const Kernel& smooth) {
    Plane along_x = correlate(luminance, detector, smooth);
    const Plane along_y = correlate(luminance, smooth, detector);
    for (std::size_t i = 0; i < along_x.values.size(); ++i) {
        along_x.values[i] = std::hypot(along_x.values[i], along_y.values[i]);
    }
    return along_x;
}

Plane normalized_luminance(const Plane& y) {
    Plane luminance = y;
    for (float& value : luminance.values) value = (value + 16.0f) / 116.0f;
    return luminance;
}

// The largest distance of two colours in the cube, that of green and blue, to the power q_c.
float largest_colour_error() {
    const Colour green = hunt_lab_from_linear_rgb({0.0f, 1.0f, 0.0f});
    const Colour blue = hunt_lab_from_linear_rgb({0.0f, 0.0f, 1.0f});
    return std::pow(hyab_distance(green, blue), COLOUR_EXPONENT);
}

// Most of [0, 1] goes to the errors that occur: two straight pieces with a knee.
float redistribute(float error, float largest) {
    const float knee = KNEE_ERROR * largest;
    if (error < knee) return KNEE_VALUE / knee * error;
    return KNEE_VALUE + (error - knee) / (largest - knee) * (1.0f - KNEE_VALUE);
}

// Both images linear and within [0, 1].
Image flip_of_linear(const Image& reference, const Image& image, const Filters& filters) {
    const Opponents a = opponents_of(reference);
    const Opponents b = opponents_of(image);
    const std::vector<Colour> seen_a = perceived_colours(a, filters);
    const std::vector<Colour> seen_b = perceived_colours(b, filters);
    const Plane luminance_a = normalized_luminance(a.y);
    const Plane luminance_b = normalized_luminance(b.y);
    const Plane edges_a = feature_strength(luminance_a, filters.edge, filters.smooth);
    const Plane edges_b = feature_strength(luminance_b, filters.edge, filters.smooth);
    const Plane points_a = feature_strength(luminance_a, filters.point, filters.smooth);
    const Plane points_b = feature_strength(luminance_b, filters.point, filters.smooth);

    const float largest = largest_colour_error();
    Image map(reference.width, reference.height, 1);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const float colour =
            redistribute(std::pow(hyab_distance(seen_a[i], seen_b[i]), COLOUR_EXPONENT), largest);
        const float edge = std::abs(edges_a.values[i] - edges_b.values[i]);
        const float point = std::abs(points_a.values[i] - points_b.values[i]);
        const float feature =
            std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, FEATURE_EXPONENT);
        // Where colours agree there is nothing to see, however strong the feature: 0^0 would say 1.
        map.values[i] = colour > 0.0f ? std::min(std::pow(colour, 1.0f - feature), 1.0f) : 0.0f;
    }
    return map;
}

// A copy with `convert` applied to every finite pixel; pixels that are not finite in either image become
// black.
template <class Convert>
Image converted(const Image& source, const Image& other, Convert convert) {
    Image result(source.width, source.height, 3);
    for (std::size_t i = 0; i < source.pixel_count(); ++i) {
        if (!is_pixel_finite(source, other, i)) continue;
        for (std::size_t c = 0; c < 3; ++c) result.values[3 * i + c] = convert(source.values[3 * i + c]);
    }
    return result;
}

void mark_non_finite(Image& map, const Image& reference, const Image& image) {
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        if (!is_pixel_finite(reference, image, i)) map.values[i] = std::numeric_limits<float>::quiet_NaN();
    }
}

// The ACES approximation (K. Narkowicz, 2016) as the paper uses it: y = (k0 x^2 + k1 x) / (k3 x^2 + k4 x +
// k5), with the pre-exposure of 0.6 in the constants.
constexpr double K0 = 0.6 * 0.6 * 2.51;
constexpr double K1 = 0.6 * 0.03;
constexpr double K3 = 0.6 * 0.6 * 2.43;
constexpr double K4 = 0.6 * 0.59;
constexpr double K5 = 0.14;

float tone_map_aces(float radiance) {
    const double x =
        std::min(double(radiance), 1e9);  // white long before; keeps infinity out of the quotient
    const double numerator = (K0 * x + K1) * x;
    const double denominator = (K3 * x + K4) * x + K5;
    return float(std::clamp(numerator / denominator, 0.0, 1.0));
}

// The x with tone_map_aces(x) = y.
double inverse_aces(double y) {
    const double a = K0 - K3 * y;
    const double half_b = 0.5 * (K1 - K4 * y) / a;
    return -half_b + std::sqrt(half_b * half_b + K5 * y / a);
}

void find_exposures(const Image& reference, HdrFlip& flip) {
    constexpr double WHITE_SHARE = 0.85;
    std::vector<float> luminances(reference.pixel_count());
    for (std::size_t i = 0; i < luminances.size(); ++i) {
        const float* rgb = &reference.values[3 * i];
        luminances[i] = luminance(vec3(rgb[0], rgb[1], rgb[2]));
    }
    std::sort(luminances.begin(), luminances.end());
    const float brightest = luminances.back();
    flip.exposure_count = 1;
    if (brightest <= 0.0f) return;
    // A reference that is mostly black has no median to expose for: the smallest float step near 1 stands in.
    const std::size_t middle = luminances.size() / 2;
    const double median = luminances.size() % 2 == 1
                              ? luminances[middle]
                              : 0.5 * (double(luminances[middle - 1]) + luminances[middle]);
    const double x = inverse_aces(WHITE_SHARE);
    flip.start_exposure_ev = std::log2(x / brightest);
    flip.stop_exposure_ev = std::log2(x / std::max(median, double(std::numeric_limits<float>::epsilon())));
    flip.stop_exposure_ev = std::max(flip.stop_exposure_ev, flip.start_exposure_ev);
    flip.exposure_count = std::max(2, int(std::ceil(flip.stop_exposure_ev - flip.start_exposure_ev)));
}

}  // namespace

Image compute_ldr_flip(const Image& reference, const Image& image, double pixels_per_degree) {
    check_comparable(reference, image);
    const auto linear = [](float encoded) { return decode_srgb(std::clamp(encoded, 0.0f, 1.0f)); };
    Image map = flip_of_linear(converted(reference, image, linear), converted(image, reference, linear),
                               Filters(pixels_per_degree));
    mark_non_finite(map, reference, image);
    return map;
}

HdrFlip compute_hdr_flip(const Image& reference, const Image& image, double pixels_per_degree) {
    check_comparable(reference, image);
    const auto positive = [](float radiance) { return std::max(radiance, 0.0f); };
    const Image a = converted(reference, image, positive);
    const Image b = converted(image, reference, positive);
    HdrFlip flip;
    find_exposures(a, flip);
    const Filters filters(pixels_per_degree);
    const double step =
        (flip.stop_exposure_ev - flip.start_exposure_ev) / std::max(flip.exposure_count - 1, 1);
    std::vector<Image> maps(std::size_t(flip.exposure_count));
    tbb::parallel_for(0, flip.exposure_count, [&](int index) {
        const float scale = float(std::exp2(flip.start_exposure_ev + index * step));
        const auto exposed = [&](float radiance) { return tone_map_aces(scale * radiance); };
        maps[std::size_t(index)] =
            flip_of_linear(converted(a, b, exposed), converted(b, a, exposed), filters);
    });
    flip.map = maps[0];
    for (const Image& map : maps) {
        for (std::size_t i = 0; i < map.values.size(); ++i) {
            flip.map.values[i] = std::max(flip.map.values[i], map.values[i]);
        }
    }
    mark_non_finite(flip.map, reference, image);
    return flip;
}

double mean_error(const Image& map) {
    double sum = 0;
    std::size_t count = 0;
    for (const float value : map.values) {
        if (!std::isfinite(value)) continue;
        sum += value;
        ++count;
    }
    return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / double(count);
}

}  // namespace tarn
