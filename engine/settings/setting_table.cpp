// The rows: what each setting is called, does and accepts.
#include "settings/setting_rows.h"
#include "settings/settings.h"

namespace tarn {
namespace {

struct PrimaryPart {
    PrimarySettings& operator()(RenderSettings& s) const { return s.primary; }
    const PrimarySettings& operator()(const RenderSettings& s) const { return s.primary; }
};

struct DirectPart {
    DirectSettings& operator()(RenderSettings& s) const { return s.direct; }
    const DirectSettings& operator()(const RenderSettings& s) const { return s.direct; }
};

struct DirectReusePart {
    ReuseSettings& operator()(RenderSettings& s) const { return s.direct.reuse; }
    const ReuseSettings& operator()(const RenderSettings& s) const { return s.direct.reuse; }
};

struct IndirectPart {
    IndirectSettings& operator()(RenderSettings& s) const { return s.indirect; }
    const IndirectSettings& operator()(const RenderSettings& s) const { return s.indirect; }
};

struct IndirectReusePart {
    ReuseSettings& operator()(RenderSettings& s) const { return s.indirect.reuse; }
    const ReuseSettings& operator()(const RenderSettings& s) const { return s.indirect.reuse; }
};

struct DenoisePart {
    DenoiseSettings& operator()(RenderSettings& s) const { return s.denoise; }
    const DenoiseSettings& operator()(const RenderSettings& s) const { return s.denoise; }
};

struct AntialiasPart {
    AntialiasSettings& operator()(RenderSettings& s) const { return s.antialias; }
    const AntialiasSettings& operator()(const RenderSettings& s) const { return s.antialias; }
};

void add_primary_rows(std::vector<Setting>& table) {
    SettingRows<PrimaryPart>(table, "").choose(
        "primary",
        "How pixels find what they see: GL rasterizes all triangles in view, or a ray each on the "
        "worker threads; auto: rays where the CPU would rasterize and triangles are many for the "
        "pixels",
        &PrimarySettings::visibility, {"auto", "raster", "rays"});
}

void add_direct_rows(std::vector<Setting>& table) {
    using S = DirectSettings;
    SettingRows<DirectPart> rows(table, "");
    rows.choose(
        "direct",
        "How direct light chooses its sample: one random light, one by power, one by the light tree, RIS "
        "over many candidates, or RIS with samples reused over time and neighbours",
        &S::mode, {"uniform", "power", "light-tree", "ris", "restir"});
    rows.where(&S::resamples)
        .choose("light-selection",
                "How a candidate of ris and restir finds its light; tiles: by power, drawn in advance",
                &S::light_selection, {"uniform", "power", "tiles", "tree"})
        .number("candidates", "", "Light candidates a pixel that ris and restir choose from", &S::candidates,
                1, 1024)
        .toggle("brdf-candidate",
                "One candidate more from a ray along the BRDF, joined by MIS: for mirrors and glossy floors",
                &S::brdf_candidate);
    rows.where([](const RenderSettings& s) { return !s.direct.reuses(); })
        .number("samples", "", "Samples a pixel and frame, each with a ray; reuse keeps one", &S::samples, 1,
                256);
    rows.where(SettingRows<DirectPart>::Applies())
        .toggle("per-channel",
                "A sample for each of red, green and blue: no colour noise or leak, three times the cost",
                &S::per_channel);
}

// Rows of the steps over time; they show where these run.
template <class Part>
void add_temporal_rows(SettingRows<Part>& rows) {
    using S = ReuseSettings;
    rows.number("confidence-cap", "x",
                "restir: confidence of the history at most, as a multiple of the fresh sample's",
                &S::confidence_cap, 1, 1000)
        .number("motion-cap", "x",
                "restir: the same cap in frames in which camera, lights or geometry moved: a long history "
                "adds noise there",
                &S::motion_cap, 1, 1000)
        .number("age-cap", "frames", "restir: drop samples older than this; 0: never", &S::age_cap, 0, 1000)
        .number(
            "boiling-filter", "x",
            "restir: drop samples that outweigh the mean of their 8 x 8 pixels this many times; darkens; 0: "
            "none",
            &S::boiling_filter, 0, 1000)
        .toggle("permute", "restir: neighbours swap their histories, so that fewer share a sample",
                &S::permute);
}

template <class Part>
void add_spatial_rows(SettingRows<Part>& rows) {
    using S = ReuseSettings;
    rows.number("spatial-iterations", "", "restir: steps of reuse over neighbours", &S::spatial_iterations, 1,
                4)
        .number("neighbours", "", "restir: neighbours a step", &S::neighbours, 1, 9)
        .number("radius", "px", "restir: greatest distance of a neighbour", &S::radius_px, 1, 100)
        .toggle("mirror",
                "restir: neighbours outside of the picture are mirrored into it instead of left out",
                &S::mirror);
}

template <class Part>
void add_weight_rows(SettingRows<Part>& rows) {
    using S = ReuseSettings;
    rows.choose("mis",
                "restir: weights of reused samples: 1/M, 1/Z, generalized balance heuristic, pairwise with a "
                "defensive share",
                &S::mis, {"1/M", "1/Z", "balance", "pairwise"})
        .toggle(
            "mis-visibility",
            "restir: trace visibility in the weights, which makes 1/Z, balance and pairwise unbiased; direct "
            "light also while things move",
            &S::mis_visibility)
        .choose("final-visibility",
                "restir: how the visibility of the sample that lights the pixel is known: traced at the end, "
                "reused "
                "with it, or averaged over all samples of each step (Tokuyoshi)",
                &S::final_visibility, {"traced", "reused", "averaged"});
}

// The rows of reuse. `stage_reuses` says whether its stage reuses anything.
template <class Part>
void add_reuse_rows(std::vector<Setting>& table, const std::string& prefix,
                    bool (*stage_reuses)(const RenderSettings&)) {
    using S = ReuseSettings;
    SettingRows<Part> rows(table, prefix);
    const auto where = [stage_reuses](auto holds) {
        return [=](const RenderSettings& s) { return stage_reuses(s) && holds(Part()(s)); };
    };
    rows.where(where([](const S&) { return true; }))
        .choose("reuse", "restir: which samples are reused", &S::reuse,
                {"none", "temporal", "spatial", "spatiotemporal"});
    rows.where(where([](const S& s) { return s.reuses_space(); }));
    add_spatial_rows(rows);
    rows.where(where([](const S& s) { return s.reuses_time() && s.reuses_space(); }))
        .toggle("feedback",
                "restir: the next frame reuses the result of spatial reuse, instead of that of temporal "
                "reuse: a sample has "
                "seen more candidates, but more pixels end up with the same one",
                &S::feedback);
    rows.where(where([](const S& s) { return s.reuse != Reuse::NONE; }));
    add_weight_rows(rows);
    rows.where(where([](const S& s) { return s.can_shade_all(); }))
        .choose("shade",
                "restir: what lights a pixel: its chosen sample, or all of the last step by their weights",
                &S::shade, {"chosen", "all"});
    rows.where(where([](const S& s) { return s.reuses_time(); }));
    add_temporal_rows(rows);
}

bool direct_reuses(const RenderSettings& s) {
    return s.direct.uses_restir();
}

bool indirect_reuses(const RenderSettings& s) {
    return s.indirect.uses_restir();
}

// Fresh light samples may be hidden; fresh path samples never are.
void add_visibility_reuse_row(std::vector<Setting>& table) {
    SettingRows<DirectReusePart>(table, "")
        .where(
            [](const RenderSettings& s) { return direct_reuses(s) && s.direct.reuse.reuse != Reuse::NONE; })
        .toggle("visibility-reuse",
                "restir: drop fresh samples that are occluded before they are reused (Bitterli et al. 2020)",
                &ReuseSettings::visibility_reuse);
}

void add_indirect_rows(std::vector<Setting>& table) {
    using S = IndirectSettings;
    SettingRows<IndirectPart> rows(table, "");
    rows.choose(
        "indirect",
        "Light that comes by way of other surfaces: none, one path a pixel, or path samples reused over "
        "time and neighbours",
        &S::mode, {"off", "path", "restir"});
    rows.where(&S::runs)
        .choose("indirect-resolution",
                "Pixels that send paths: all, or one of 2 x 2 or 4 x 4; the others take its light where "
                "surfaces are alike",
                &S::resolution, {"full", "half", "quarter"})
        .number("indirect-bounces", "", "Surfaces that light meets before the one that is seen", &S::bounces,
                1, 16)
        .choose("indirect-sampling",
                "How the first direction of a path is drawn: evenly, by the cosine or by the BRDF",
                &S::sampling, {"uniform", "cosine", "brdf"})
        .choose(
            "noise",
            "Random numbers of that direction: white, or blue over pixels and frames, which filters remove "
            "better",
            &S::noise, {"white", "blue"})
        .number("indirect-candidates", "", "Light candidates at each surface that a path meets",
                &S::candidates, 1, 64)
        .choose("indirect-light-selection",
                "How these candidates find their lamps: by power, or by a walk down the light tree for the "
                "surface at hand",
                &S::lights, {"power", "tree"})
        .number("indirect-light-rays", "",
                "Of paths, the share whose last surface sends a ray that looks for lamps: what it may meet, "
                "candidates leave to it, so that none is worth very much",
                &S::light_rays, 0, 1)
        .choose(
            "indirect-cache",
            "Light of all further bounces, where paths end: none, what the last frame saw there, or a grid "
            "in world space; biased",
            &S::cache, {"off", "screen", "world"});
}

void add_denoise_rows(std::vector<Setting>& table) {
    using S = DenoiseSettings;
    SettingRows<DenoisePart> rows(table, "");
    rows.choose("denoise",
                "Remove noise over time and neighbours: not at all, guided by variance (SVGF) with a history "
                "that is cut short where light changes or without that, or by surfaces alone",
                &S::mode, {"off", "svgf", "svgf-static", "bilateral"});
    rows.where(&S::runs)
        .number("denoise-steps", "",
                "Steps of the filter over neighbours, each twice as wide as the one before", &S::steps, 1, 6)
        .choose("denoise-kernel", "Pixels that a step of the filter looks at: 5, 9 or 25", &S::kernel,
                {"cross", "3x3", "5x5"})
        .number("denoise-history", "frames", "The history counts as so many frames at most", &S::history, 1,
                63);
}

void add_antialias_rows(std::vector<Setting>& table) {
    using S = AntialiasSettings;
    SettingRows<AntialiasPart> rows(table, "");
    rows.choose(
            "antialias",
            "Smooth edges and fine texture: not at all; jitter, where each frame samples another place of "
            "each pixel, for means over frames; or over time (TAA), where each joins the picture of the "
            "last ones too",
            &S::mode, {"off", "jitter", "taa"})
        .number("scale", "x",
                "Width and height of what is rendered, as a share of the picture's; the picture is enlarged, "
                "by bilinear interpolation or by antialias=taa, which joins the samples of several frames",
                &S::scale, 0.25, 1);
    rows.where(&S::joins_frames)
        .choose("antialias-mean",
                "What a pixel is the mean of: radiance, which keeps all energy, or radiance as the display "
                "shows it, which smooths the edges of lamps too",
                &S::mean, {"radiance", "display"});
}

void add_indirect_target_row(std::vector<Setting>& table) {
    SettingRows<IndirectPart>(table, "")
        .where([](const RenderSettings& s) {
            return indirect_reuses(s) && s.indirect.reuse.reuse != Reuse::NONE;
        })
        .choose(
            "indirect-target",
            "restir: what path samples are kept in proportion to: the luminance of their light, that of what "
            "the surface reflects of it, or each channel of that with a sample of its own (no colour noise, "
            "three times the cost of reuse)",
            &IndirectSettings::target, {"luminance", "brdf", "channel"});
}

// What kept path samples know of their lamps grows old; where the weights trace, it is asked anew at once.
void add_validation_row(std::vector<Setting>& table) {
    SettingRows<IndirectPart>(table, "")
        .where([](const RenderSettings& s) {
            const ReuseSettings& reuse = s.indirect.reuse;
            return indirect_reuses(s) && reuse.reuses_time() && !reuse.traces_in_mis();
        })
        .number(
            "indirect-validation", "frames",
            "restir: while things change, test by rays every so many frames whether kept samples still see "
            "their lamps; 0: never. With indirect-mis-visibility it is tested in every frame",
            &IndirectSettings::validation, 0, 64);
}

void add_view_rows(std::vector<Setting>& table) {
    SettingRows<DirectPart>(table, "").choose(
        "debug-view",
        "Show the visibility of the chosen samples, their light without it, or which they are, in colours; "
        "or of "
        "the path samples of indirect=restir: direction, distance [m] and normal of the place, its radiance, "
        "the "
        "contribution weight, the age [frames]",
        &DirectSettings::debug_view,
        {"none", "visibility", "unshadowed", "samples", "path-direction", "path-distance", "path-normal",
         "path-radiance", "path-weight", "path-age"});
}

}  // namespace

const std::vector<Setting>& setting_table() {
    static const std::vector<Setting> table = [] {
        std::vector<Setting> rows;
        add_direct_rows(rows);
        add_reuse_rows<DirectReusePart>(rows, "", direct_reuses);
        add_visibility_reuse_row(rows);
        add_indirect_rows(rows);
        add_reuse_rows<IndirectReusePart>(rows, "indirect-", indirect_reuses);
        add_indirect_target_row(rows);
        add_validation_row(rows);
        add_denoise_rows(rows);
        add_antialias_rows(rows);
        add_primary_rows(rows);
        add_view_rows(rows);
        return rows;
    }();
    return table;
}

}  // namespace tarn
