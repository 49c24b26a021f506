#include "plan/shader_variants.h"

#include <fmt/format.h>

#include <array>

namespace tarn {
namespace {

constexpr Mis ALL_MIS[] = {Mis::ONE_OVER_M, Mis::ONE_OVER_Z, Mis::BALANCE, Mis::PAIRWISE};

const char* define_of(LightSelection selection) {
    switch (selection) {
        case LightSelection::UNIFORM:
            return "TARN_SELECT_UNIFORM";
        case LightSelection::POWER:
            return "TARN_SELECT_POWER";
        case LightSelection::TILES:
            return "TARN_SELECT_TILES";
        case LightSelection::TREE:
            return "TARN_SELECT_TREE";
    }
    return "";
}

const char* define_of(DebugView view) {
    switch (view) {
        case DebugView::NONE:
            break;
        case DebugView::VISIBILITY:
            return "TARN_SHOW_VISIBILITY";
        case DebugView::UNSHADOWED:
            return "TARN_SHOW_UNSHADOWED";
        case DebugView::SAMPLES:
            return "TARN_SHOW_SAMPLES";
        default:  // of indirect light
            break;
    }
    return nullptr;
}

Defines define_of(IndirectSampling sampling) {
    switch (sampling) {
        case IndirectSampling::UNIFORM:
            return {"TARN_SAMPLE_UNIFORM"};
        case IndirectSampling::COSINE:
            return {"TARN_SAMPLE_COSINE"};
        case IndirectSampling::BRDF:
            break;
    }
    return {};
}

template <class Variant>
ShaderFamily family_of() {
    ShaderFamily family{Variant::PATH, Variant::IS_OF_SCENE, {}};
    for (const Variant& variant : Variant::all()) family.variants.push_back(variant.defines());
    return family;
}

}  // namespace

Defines RasterVariant::defines() const {
    return coverage ? Defines{"TARN_COVERAGE"} : Defines{};
}

std::vector<RasterVariant> RasterVariant::all() {
    return {{false}, {true}};
}

Defines CandidatesVariant::defines() const {
    Defines result = {define_of(selection)};
    if (brdf_candidate) result.emplace_back("TARN_BRDF_CANDIDATE");
    return result;
}

std::vector<CandidatesVariant> CandidatesVariant::all() {
    std::vector<CandidatesVariant> result;
    for (const LightSelection selection :
         {LightSelection::UNIFORM, LightSelection::POWER, LightSelection::TILES, LightSelection::TREE}) {
        for (const bool brdf : {false, true}) result.push_back({selection, brdf});
    }
    return result;
}

Defines ReuseVariant::defines() const {
    Defines result = {fmt::format("TARN_MIS={}", int(mis)),
                      fmt::format("TARN_MIS_VISIBILITY={}", mis_visibility ? 1 : 0),
                      fmt::format("TARN_FINAL_VISIBILITY={}", int(final_visibility))};
    if (run == ReuseRun::WRITE_RAYS) result.emplace_back("TARN_WRITE_RAYS");
    if (run == ReuseRun::MERGE_AND_TEST) result.emplace_back("TARN_LAST_STEP");
    if (run == ReuseRun::MERGE_AND_SHADE) result.emplace_back("TARN_SHADE_ALL");
    return result;
}

std::vector<ReuseVariant> ReuseVariant::all(bool shades) {
    std::vector<ReuseVariant> result;
    for (const Mis mis : ALL_MIS) {
        for (const bool mis_visibility : {false, true}) {
            for (const FinalVisibility visibility :
                 {FinalVisibility::TRACED, FinalVisibility::REUSED, FinalVisibility::AVERAGED}) {
                if (mis_visibility && (mis == Mis::ONE_OVER_M || visibility != FinalVisibility::TRACED))
                    continue;
                for (const ReuseRun run : {ReuseRun::WRITE_RAYS, ReuseRun::MERGE, ReuseRun::MERGE_AND_TEST})
                    result.push_back({mis, mis_visibility, visibility, run});
                if (shades) result.push_back({mis, mis_visibility, visibility, ReuseRun::MERGE_AND_SHADE});
            }
        }
    }
    return result;
}

std::vector<TemporalVariant> TemporalVariant::all() {
    std::vector<TemporalVariant> result;
    for (const ReuseVariant& reuse : ReuseVariant::all(false)) result.push_back({reuse});
    return result;
}

Defines SpatialVariant::defines() const {
    Defines result = reuse.defines();
    result.push_back(fmt::format("TARN_NEIGHBOURS={}", neighbours));
    return result;
}

// The loops over neighbours are alike for every number of them: the least, the most and the presets' one
// stand for the rest.
std::vector<SpatialVariant> SpatialVariant::all() {
    std::vector<SpatialVariant> result;
    for (const ReuseVariant& reuse : ReuseVariant::all(true)) result.push_back({reuse, 3});
    for (const int neighbours : {1, 9}) result.push_back({ReuseVariant{}, neighbours});
    return result;
}

std::vector<IndirectTemporalVariant> IndirectTemporalVariant::all() {
    std::vector<IndirectTemporalVariant> result;
    for (const TemporalVariant& variant : TemporalVariant::all()) result.push_back({variant});
    return result;
}

std::vector<IndirectSpatialVariant> IndirectSpatialVariant::all() {
    std::vector<IndirectSpatialVariant> result;
    for (const SpatialVariant& variant : SpatialVariant::all()) result.push_back({variant});
    return result;
}

Defines IndirectRaysVariant::defines() const {
    Defines result = define_of(sampling);
    if (noise == NoiseKind::BLUE) result.emplace_back("TARN_BLUE_NOISE");
    return result;
}

std::vector<IndirectRaysVariant> IndirectRaysVariant::all() {
    std::vector<IndirectRaysVariant> result;
    for (const IndirectSampling sampling :
         {IndirectSampling::UNIFORM, IndirectSampling::COSINE, IndirectSampling::BRDF}) {
        for (const NoiseKind noise : {NoiseKind::WHITE, NoiseKind::BLUE}) result.push_back({sampling, noise});
    }
    return result;
}

Defines PathVerticesVariant::defines() const {
    Defines result;
    if (is_first) result.emplace_back("TARN_FIRST_VERTEX");
    if (is_last) result.emplace_back("TARN_LAST_VERTEX");
    if (cache == IndirectCache::SCREEN) result.emplace_back("TARN_CACHE_SCREEN");
    if (cache == IndirectCache::WORLD) result.emplace_back("TARN_CACHE_WORLD");
    if (lights == PathLights::TREE) result.emplace_back("TARN_SELECT_TREE");
    return result;
}

Defines CacheVerticesVariant::defines() const {
    if (lights == PathLights::TREE) return {"TARN_SELECT_TREE"};
    return {};
}

std::vector<PathVerticesVariant> PathVerticesVariant::all() {
    std::vector<PathVerticesVariant> result;
    for (const bool is_first : {true, false}) {
        for (const PathLights lights : {PathLights::POWER, PathLights::TREE}) {
            result.push_back({is_first, false, IndirectCache::OFF, lights});
            for (const IndirectCache cache :
                 {IndirectCache::OFF, IndirectCache::SCREEN, IndirectCache::WORLD})
                result.push_back({is_first, true, cache, lights});
        }
    }
    return result;
}

Defines PathSamplesVariant::defines() const {
    Defines result = define_of(sampling);
    if (shades) result.emplace_back("TARN_SHADE");
    if (light_rays) result.emplace_back("TARN_LIGHT_RAYS");
    if (light_rays && lights == PathLights::TREE) result.emplace_back("TARN_SELECT_TREE");
    return result;
}

std::vector<PathSamplesVariant> PathSamplesVariant::all() {
    std::vector<PathSamplesVariant> result;
    for (const IndirectSampling sampling :
         {IndirectSampling::UNIFORM, IndirectSampling::COSINE, IndirectSampling::BRDF}) {
        for (const bool shades : {false, true}) {
            result.push_back({sampling, shades});
            for (const PathLights lights : {PathLights::POWER, PathLights::TREE})
                result.push_back({sampling, shades, lights, true});
        }
    }
    return result;
}

Defines IndirectShadeVariant::defines() const {
    Defines result;
    if (source == ShadeSource::RESERVOIR) result.emplace_back("TARN_RESERVOIR_VISIBILITY");
    if (source == ShadeSource::SUMMED) result.emplace_back("TARN_SHADED");
    if (shows_paths) result.emplace_back("TARN_SHOW_PATHS");
    if (one_channel) result.emplace_back("TARN_ONE_CHANNEL");
    if (adds) result.emplace_back("TARN_ADD");
    return result;
}

std::vector<IndirectShadeVariant> IndirectShadeVariant::all() {
    std::vector<IndirectShadeVariant> result = {{ShadeSource::RESERVOIR, true}};
    for (const ShadeSource source : {ShadeSource::TRACED, ShadeSource::RESERVOIR, ShadeSource::SUMMED}) {
        result.push_back({source});
        for (const bool adds : {false, true}) result.push_back({source, false, true, adds});
    }
    return result;
}

Defines ShadeVariant::defines() const {
    Defines result;
    if (source == ShadeSource::RESERVOIR) result.emplace_back("TARN_RESERVOIR_VISIBILITY");
    if (source == ShadeSource::SUMMED) result.emplace_back("TARN_SHADED");
    if (const char* define = define_of(view)) result.emplace_back(define);
    if (one_channel) result.emplace_back("TARN_ONE_CHANNEL");
    if (adds) result.emplace_back("TARN_ADD");
    return result;
}

std::vector<ShadeVariant> ShadeVariant::all() {
    std::vector<ShadeVariant> result;
    for (const ShadeSource source : {ShadeSource::TRACED, ShadeSource::RESERVOIR, ShadeSource::SUMMED}) {
        for (const DebugView view :
             {DebugView::NONE, DebugView::VISIBILITY, DebugView::UNSHADOWED, DebugView::SAMPLES}) {
            if (source == ShadeSource::SUMMED && view != DebugView::NONE) continue;
            for (const bool one_channel : {false, true}) {
                for (const bool adds : {false, true}) result.push_back({source, view, one_channel, adds});
            }
        }
    }
    return result;
}

Defines DenoiseAccumulateVariant::defines() const {
    Defines result;
    if (indirect) result.emplace_back("TARN_INDIRECT");
    if (adapts) result.emplace_back("TARN_ADAPTIVE");
    return result;
}

std::vector<DenoiseAccumulateVariant> DenoiseAccumulateVariant::all() {
    return {{false, false}, {false, true}, {true, false}, {true, true}};
}

Defines LightSamplesVariant::defines() const {
    return asks_rays ? Defines{"TARN_ASK_RAYS"} : Defines{};
}

std::vector<LightSamplesVariant> LightSamplesVariant::all() {
    return {{false}, {true}};
}

Defines DenoiseFilterVariant::defines() const {
    constexpr std::array<const char*, 3> KERNELS = {"TARN_KERNEL_CROSS", "TARN_KERNEL_BOX3",
                                                    "TARN_KERNEL_BOX5"};
    Defines result = {KERNELS[std::size_t(kernel)]};
    if (!by_variance) result.emplace_back("TARN_BILATERAL");
    if (is_first) result.emplace_back("TARN_FIRST_STEP");
    if (is_last) result.emplace_back("TARN_LAST_STEP");
    return result;
}

std::vector<DenoiseFilterVariant> DenoiseFilterVariant::all() {
    std::vector<DenoiseFilterVariant> result;
    for (const DenoiseKernel kernel : {DenoiseKernel::CROSS, DenoiseKernel::BOX3, DenoiseKernel::BOX5}) {
        for (const bool is_last : {false, true}) {
            for (const bool is_first : {false, true}) result.push_back({kernel, true, is_first, is_last});
            result.push_back({kernel, false, false, is_last});
        }
    }
    return result;
}

Defines CompositeVariant::defines() const {
    Defines result;
    if (indirect) result.emplace_back("TARN_INDIRECT");
    if (light_alone) result.emplace_back("TARN_LIGHT_ALONE");
    if (indirect_alone) result.emplace_back("TARN_INDIRECT_ALONE");
    return result;
}

std::vector<CompositeVariant> CompositeVariant::all() {
    return {{false, false}, {false, true}, {true, false}, {true, true}, {true, true, true}};
}

Defines AntialiasVariant::defines() const {
    Defines result;
    if (at_rest) result.emplace_back("TARN_AT_REST");
    if (enlarges) result.emplace_back("TARN_ENLARGE");
    if (mean == AntialiasMean::DISPLAY) result.emplace_back("TARN_DISPLAY_MEAN");
    return result;
}

std::vector<AntialiasVariant> AntialiasVariant::all() {
    std::vector<AntialiasVariant> result;
    for (const AntialiasMean mean : {AntialiasMean::RADIANCE, AntialiasMean::DISPLAY}) {
        for (const bool at_rest : {false, true}) {
            for (const bool enlarges : {false, true}) result.push_back({at_rest, enlarges, mean});
        }
    }
    return result;
}

Defines DisplayVariant::defines() const {
    constexpr std::array<const char*, DISPLAY_VIEW_COUNT> DEFINES = {
        "TARN_VIEW_RADIANCE",       "TARN_VIEW_LUMINANCE",         "TARN_VIEW_ALBEDO",
        "TARN_VIEW_EMISSION",       "TARN_VIEW_GEOMETRIC_NORMALS", "TARN_VIEW_SHADING_NORMALS",
        "TARN_VIEW_POSITION_ERROR", "TARN_VIEW_PRIMITIVES"};
    Defines defines = {DEFINES[std::size_t(view)]};
    if (glare) defines.push_back("TARN_GLARE");
    return defines;
}

std::vector<DisplayVariant> DisplayVariant::all() {
    std::vector<DisplayVariant> result;
    for (int view = 0; view < DISPLAY_VIEW_COUNT; ++view) result.push_back({DisplayView(view)});
    result.push_back({DisplayView::RADIANCE, true});
    return result;
}

Defines GlareDownVariant::defines() const {
    return is_first ? Defines{"TARN_GLARE_FIRST"} : Defines{};
}

std::vector<GlareDownVariant> GlareDownVariant::all() {
    return {{true}, {false}};
}

std::vector<ShaderFamily> shader_families() {
    return {family_of<RasterVariant>(),
            family_of<ResolveVariant>(),
            family_of<LightTilesVariant>(),
            family_of<BrdfRaysVariant>(),
            family_of<CandidatesVariant>(),
            family_of<InitialVisibilityVariant>(),
            family_of<TemporalVariant>(),
            family_of<BoilingFilterVariant>(),
            family_of<SpatialVariant>(),
            family_of<ShadeVariant>(),
            family_of<CoarseSurfacesVariant>(),
            family_of<UpsampleVariant>(),
            family_of<IndirectRaysVariant>(),
            family_of<PathVerticesVariant>(),
            family_of<CacheRaysVariant>(),
            family_of<CacheVerticesVariant>(),
            family_of<CacheUpdateVariant>(),
            family_of<CacheResolveVariant>(),
            family_of<PathSamplesVariant>(),
            family_of<IndirectTemporalVariant>(),
            family_of<IndirectBoilingFilterVariant>(),
            family_of<IndirectSpatialVariant>(),
            family_of<IndirectShadeVariant>(),
            family_of<LightSamplesVariant>(),
            family_of<LightChangesVariant>(),
            family_of<DenoiseAccumulateVariant>(),
            family_of<DenoiseFilterVariant>(),
            family_of<CompositeVariant>(),
            family_of<AntialiasVariant>(),
            family_of<EnlargeVariant>(),
            family_of<AverageVariant>(),
            family_of<AverageErrorVariant>(),
            family_of<ExposureCountVariant>(),
            family_of<ExposureVariant>(),
            family_of<GlareDownVariant>(),
            family_of<GlareUpVariant>(),
            family_of<DisplayVariant>()};
}

}  // namespace tarn
