#include "metrics/step_response.h"

#include "core/statistics.h"

namespace tarn {
namespace {

double dot(const Image& a, const Image& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) sum += double(a.values[i]) * b.values[i];
    return sum;
}

Image subtract(Image a, const Image& b) {
    for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
    return a;
}

template <class Does>
std::optional<int> first_frame(const std::vector<double>& values, const Does& does) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (does(values[i])) return int(i) + 1;
    }
    return std::nullopt;
}

}  // namespace

void StepResponse::add_after(int frame, const Image& picture) {
    const auto index = std::size_t(frame);
    frames_[index].add(picture);
    pictures_[index].push_back(picture);
    if (index >= frames_.size() / 2) after_.add(picture);
}

std::vector<double> StepResponse::progress() const {
    const Image before = before_.mean();
    const Image change = subtract(after_.mean(), before);
    const double whole = dot(change, change);
    std::vector<double> progress;
    for (const FrameMean& frame : frames_) {
        progress.push_back(whole > 0.0 ? dot(subtract(frame.mean(), before), change) / whole : 1.0);
    }
    return progress;
}

std::vector<double> StepResponse::noise() const {
    const Image after = after_.mean();
    std::vector<double> noise;
    for (const std::vector<Image>& seeds : pictures_) {
        RunningMoments moments;
        for (const Image& picture : seeds) {
            const Image error = subtract(picture, after);
            moments.add(dot(error, error) / double(error.values.size()));
        }
        noise.push_back(moments.mean());
    }
    return noise;
}

std::optional<int> StepResponse::frames_to_reach(double share) const {
    return first_frame(progress(), [&](double reached) { return reached >= share; });
}

std::optional<int> StepResponse::frames_to_settle(double times) const {
    const std::vector<double> all = noise();
    RunningMoments end;
    for (std::size_t i = all.size() / 2; i < all.size(); ++i) end.add(all[i]);
    return first_frame(all, [&](double mse) { return mse <= times * end.mean(); });
}

}  // namespace tarn
