// tarn study cache: what light of many bounces costs, and what of it arrives: paths of several bounces beside
// paths of one whose further light comes out of a cache.
#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/statistics.h"
#include "metrics/image_error.h"
#include "studies/indirect_runs.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct CacheStudy {
    RenderOptions options;
    int seeds = 2;
    int warm_up = 32;
    int frames = 8;
    int reference_spp = 256;
};

constexpr int ALL_BOUNCES = 59;  // surfaces before the one that is seen: the reference takes no more

struct CacheVariant {
    IndirectCache cache;
    int bounces;
    const char* name;
};

constexpr CacheVariant VARIANTS[] = {
    {IndirectCache::OFF, 1, "1"},
    {IndirectCache::OFF, 2, "2"},
    {IndirectCache::OFF, 4, "4"},
    {IndirectCache::OFF, 8, "8"},
    {IndirectCache::SCREEN, 1, "1, screen"},
    {IndirectCache::WORLD, 1, "1, world"},
};

struct Measured {
    RunningMoments energy;  // mean radiance of indirect light
    RunningMoments rel_mse;
    double ms = std::numeric_limits<double>::infinity();  // as in Run
};

Measured measure(RenderSession& session, const CacheStudy& study, const CacheVariant& variant,
                 const Image& all) {
    RenderSettings with = study.options.settings;
    with.indirect.cache = variant.cache;
    with.indirect.bounces = variant.bounces;
    const SceneOptions& scene = study.options.scene;
    StudySequence sequence{with, choose_camera(scene, session.loaded().scene, session.loaded().world),
                           scene.seed, study.warm_up, study.frames};
    Measured measured;
    for (int k = 0; k < study.seeds; ++k, ++sequence.seed) {
        const IndirectRun run = render_indirect_run(session.renderer(), sequence);
        for (const Image& indirect : run.frames) {
            measured.energy.add(mean_of(indirect));
            measured.rel_mse.add(compute_image_errors(all, indirect).rel_mse);
        }
        measured.ms = std::min(measured.ms, run.indirect_ms);
    }
    return measured;
}

void run(const CacheStudy& study) {
    check_output_folder(study.options.json_file);
    if (!study.options.settings.indirect.runs()) throw Error("study cache: needs --indirect path or restir");
    RenderSession session(study.options);
    IndirectReferences references(session, study.options.scene, study.reference_spp);
    const Image all = references.find(ALL_BOUNCES);
    const double all_energy = mean_of(all);
    Json rows = Json::array();
    fmt::print("{:<12} {:>26} {:>26} {:>10} {:>14}\n", "bounces", "energy / as many bounces",
               "energy / all bounces", "relMSE", "indirect [ms]");
    for (const CacheVariant& variant : VARIANTS) {
        const Measured m = measure(session, study, variant, all);
        const bool ends = variant.cache == IndirectCache::OFF;
        const double same = ends ? mean_of(references.find(variant.bounces)) : all_energy;
        fmt::print("{:<12} {:>26.4f} {:>26.4f} {:>10.4f} {:>14.1f}\n", variant.name, m.energy.mean() / same,
                   m.energy.mean() / all_energy, m.rel_mse.mean(), m.ms);
        rows.push_back({{"variant", variant.name},
                        {"energy_of_as_many_bounces", m.energy.mean() / same},
                        {"energy_of_all_bounces", m.energy.mean() / all_energy},
                        {"rel_mse", m.rel_mse.mean()},
                        {"indirect_ms", m.ms}});
    }
    if (study.options.json_file.empty()) return;
    write_json(study.options.json_file, {{"study", "cache"},
                                         {"machine", session.describe_machine()},
                                         {"seeds", study.seeds},
                                         {"warm_up", study.warm_up},
                                         {"frames", study.frames},
                                         {"variants", rows}});
}

}  // namespace

void add_cache_study(CLI::App& app) {
    auto study = std::make_shared<CacheStudy>();
    CLI::App* sub = app.add_subcommand(
        "cache", "What light of many bounces costs with and without a cache, and its bias");
    study->options.scene.scene = "cornell";
    study->options.scene.width = 320;
    study->options.scene.height = 180;
    study->options.settings.indirect.mode = IndirectMode::RESTIR;
    add_render_options(*sub, study->options);
    sub->get_option("SCENE")->required(false);
    const auto add_count = [&](const char* name, int& value, const char* what) {
        sub->add_option(name, value, what)->check(CLI::Range(1, 65536))->capture_default_str();
    };
    add_count("--seeds", study->seeds, "Independent seeds");
    add_count("--warm-up", study->warm_up, "Frames that fill the history");
    add_count("--frames", study->frames, "Frames that are measured after the warm-up");
    add_count("--reference-spp", study->reference_spp, "Samples per pixel of the references");
    sub->callback([study] { run(*study); });
}

}  // namespace tarn
