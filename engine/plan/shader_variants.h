// The variants of every entry shader. A pass asks for its program by one of these types, and nothing else: so
// what a frame can run is what `shader_families` lists and the tests compile.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plan/scene_features.h"
#include "settings/settings.h"

namespace tarn {

// For each type: PATH under shaders/passes, whether the scene's features and the planted bugs of tests
// concern it, the defines of this variant, and all variants there are.

struct RasterVariant {
    static constexpr const char* PATH = "gbuffer/raster";
    static constexpr bool IS_OF_SCENE = true;
    bool coverage = false;  // alpha MASK and BLEND
    Defines defines() const;
    static std::vector<RasterVariant> all();
};

// A shader that the scene's features alone decide.
template <class Variant>
struct PlainVariant {
    static constexpr bool IS_OF_SCENE = true;
    Defines defines() const { return {}; }
    static std::vector<Variant> all() { return {Variant{}}; }
};

struct ResolveVariant : PlainVariant<ResolveVariant> {
    static constexpr const char* PATH = "gbuffer/resolve";
};
struct LightTilesVariant : PlainVariant<LightTilesVariant> {
    static constexpr const char* PATH = "direct/light_tiles";
};
struct BrdfRaysVariant : PlainVariant<BrdfRaysVariant> {
    static constexpr const char* PATH = "direct/brdf_rays";
};
struct InitialVisibilityVariant : PlainVariant<InitialVisibilityVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "direct/initial_visibility";
};
struct BoilingFilterVariant : PlainVariant<BoilingFilterVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "direct/boiling_filter";
};

struct CandidatesVariant {
    static constexpr const char* PATH = "direct/candidates";
    static constexpr bool IS_OF_SCENE = true;
    LightSelection selection = LightSelection::POWER;
    bool brdf_candidate = false;
    Defines defines() const;
    static std::vector<CandidatesVariant> all();
};

// What a run of a step of reuse does: write the rays that its weights ask for, or merge.
enum class ReuseRun {
    WRITE_RAYS,
    MERGE,
    MERGE_AND_TEST,   // the last step: it also writes the rays that test its samples
    MERGE_AND_SHADE,  // the last spatial step, all of whose samples light the pixel
};

// What both kinds of steps have in common.
struct ReuseVariant {
    Mis mis = Mis::PAIRWISE;
    bool mis_visibility = false;
    FinalVisibility final_visibility = FinalVisibility::TRACED;
    ReuseRun run = ReuseRun::MERGE;
    Defines defines() const;
    static std::vector<ReuseVariant> all(bool shades);
};

struct TemporalVariant {
    static constexpr const char* PATH = "direct/temporal";
    static constexpr bool IS_OF_SCENE = true;
    ReuseVariant reuse;
    Defines defines() const { return reuse.defines(); }
    static std::vector<TemporalVariant> all();
};

struct SpatialVariant {
    static constexpr const char* PATH = "direct/spatial";
    static constexpr bool IS_OF_SCENE = true;
    ReuseVariant reuse;
    int neighbours = 3;
    Defines defines() const;
    static std::vector<SpatialVariant> all();
};

// Indirect light. On a coarse picture; both are of the scene for the bugs that tests plant.
struct CoarseSurfacesVariant : PlainVariant<CoarseSurfacesVariant> {
    static constexpr const char* PATH = "indirect/surfaces";
};
struct UpsampleVariant : PlainVariant<UpsampleVariant> {
    static constexpr const char* PATH = "indirect/upsample";
};

// The same for all steps of reuse, but of its own samples.
struct IndirectTemporalVariant : TemporalVariant {
    static constexpr const char* PATH = "indirect/temporal";
    static std::vector<IndirectTemporalVariant> all();
};
struct IndirectSpatialVariant : SpatialVariant {
    static constexpr const char* PATH = "indirect/spatial";
    static std::vector<IndirectSpatialVariant> all();
};
struct IndirectBoilingFilterVariant : PlainVariant<IndirectBoilingFilterVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "indirect/boiling_filter";
};

struct IndirectRaysVariant {
    static constexpr const char* PATH = "indirect/rays";
    static constexpr bool IS_OF_SCENE = true;
    IndirectSampling sampling = IndirectSampling::BRDF;
    NoiseKind noise = NoiseKind::WHITE;
    Defines defines() const;
    static std::vector<IndirectRaysVariant> all();
};

struct PathVerticesVariant {
    static constexpr const char* PATH = "indirect/vertices";
    static constexpr bool IS_OF_SCENE = true;
    bool is_first = true;
    bool is_last = true;
    IndirectCache cache = IndirectCache::OFF;  // asked for what lies beyond the last surface
    PathLights lights = PathLights::POWER;
    Defines defines() const;
    static std::vector<PathVerticesVariant> all();
};

// The radiance cache in world space.
struct CacheRaysVariant : PlainVariant<CacheRaysVariant> {
    static constexpr const char* PATH = "indirect/cache_rays";
};
struct CacheVerticesVariant {
    static constexpr const char* PATH = "indirect/cache_vertices";
    static constexpr bool IS_OF_SCENE = true;
    PathLights lights = PathLights::POWER;
    Defines defines() const;
    static std::vector<CacheVerticesVariant> all() { return {{PathLights::POWER}, {PathLights::TREE}}; }
};
struct CacheUpdateVariant : PlainVariant<CacheUpdateVariant> {
    static constexpr const char* PATH = "indirect/cache_update";
};
struct CacheResolveVariant : PlainVariant<CacheResolveVariant> {
    static constexpr const char* PATH = "indirect/cache_resolve";
};

struct PathSamplesVariant {
    static constexpr const char* PATH = "indirect/samples";
    static constexpr bool IS_OF_SCENE = true;
    IndirectSampling sampling = IndirectSampling::BRDF;
    bool shades = false;  // writes the light of the path instead of a sample
    PathLights lights = PathLights::POWER;
    bool light_rays = false;
    Defines defines() const;
    static std::vector<PathSamplesVariant> all();
};

// Where shading finds the light of a pixel.
enum class ShadeSource {
    TRACED,     // its chosen sample, whose visibility was traced after all reuse
    RESERVOIR,  // its chosen sample, with the visibility that the reservoir knows
    SUMMED,     // the sum that the last step of reuse made
};

struct IndirectShadeVariant {
    static constexpr const char* PATH = "indirect/shade";
    static constexpr bool IS_OF_SCENE = true;
    ShadeSource source = ShadeSource::TRACED;
    bool shows_paths = false;  // what samples are like instead of their light
    bool one_channel = false;  // as in ShadeVariant
    bool adds = false;
    Defines defines() const;
    static std::vector<IndirectShadeVariant> all();
};

struct ShadeVariant {
    static constexpr const char* PATH = "direct/shade";
    static constexpr bool IS_OF_SCENE = true;
    ShadeSource source = ShadeSource::TRACED;
    DebugView view = DebugView::NONE;
    bool one_channel = false;  // the sample stands for one channel alone
    bool adds = false;         // to what earlier samples of this frame gave
    Defines defines() const;
    static std::vector<ShadeVariant> all();
};

// The denoiser.
struct DenoiseAccumulateVariant {
    static constexpr const char* PATH = "denoise/accumulate";
    static constexpr bool IS_OF_SCENE = true;
    bool indirect = false;
    bool adapts = false;  // to changes of the light
    Defines defines() const;
    static std::vector<DenoiseAccumulateVariant> all();
};

struct LightSamplesVariant {
    static constexpr const char* PATH = "denoise/light_samples";
    static constexpr bool IS_OF_SCENE = true;
    bool asks_rays = false;  // whether the samples are seen
    Defines defines() const;
    static std::vector<LightSamplesVariant> all();
};
struct LightChangesVariant : PlainVariant<LightChangesVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "denoise/light_changes";
};

struct DenoiseFilterVariant {
    static constexpr const char* PATH = "denoise/filter";
    static constexpr bool IS_OF_SCENE = true;
    DenoiseKernel kernel = DenoiseKernel::BOX3;
    bool by_variance = true;  // else by surfaces alone
    bool is_first = false;    // of those by variance
    bool is_last = false;
    Defines defines() const;
    static std::vector<DenoiseFilterVariant> all();
};

struct CompositeVariant {
    static constexpr const char* PATH = "composite";
    static constexpr bool IS_OF_SCENE = false;
    bool indirect = false;
    bool light_alone = false;     // without emission
    bool indirect_alone = false;  // without direct light
    Defines defines() const;
    static std::vector<CompositeVariant> all();
};

// What a window may show of a frame.
enum class DisplayView {
    RADIANCE,
    LUMINANCE,
    ALBEDO,
    EMISSION,
    GEOMETRIC_NORMALS,
    SHADING_NORMALS,
    POSITION_ERROR,
    PRIMITIVES,
};
constexpr int DISPLAY_VIEW_COUNT = 8;

struct DisplayVariant {
    static constexpr const char* PATH = "display";
    static constexpr bool IS_OF_SCENE = false;
    DisplayView view = DisplayView::RADIANCE;
    bool glare = false;  // for radiance alone
    Defines defines() const;
    static std::vector<DisplayVariant> all();
};

// is_first: from the picture itself.
struct GlareDownVariant {
    static constexpr const char* PATH = "glare/down";
    static constexpr bool IS_OF_SCENE = false;
    bool is_first = false;
    Defines defines() const;
    static std::vector<GlareDownVariant> all();
};
struct GlareUpVariant : PlainVariant<GlareUpVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "glare/up";
};

struct AverageVariant : PlainVariant<AverageVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "average/add";
};
struct AverageErrorVariant : PlainVariant<AverageErrorVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "average/error";
};
struct ExposureCountVariant : PlainVariant<ExposureCountVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "exposure/count";
};
struct ExposureVariant : PlainVariant<ExposureVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "exposure/find";
};
struct AntialiasVariant {
    static constexpr const char* PATH = "antialias";
    static constexpr bool IS_OF_SCENE = true;
    bool at_rest = false;   // nothing has moved or changed since the last frame
    bool enlarges = false;  // the picture is larger than what is rendered
    AntialiasMean mean = AntialiasMean::RADIANCE;
    // Whether the light of lamps beyond white is kept apart.
    bool splits_excess() const { return mean == AntialiasMean::RADIANCE; }
    Defines defines() const;
    static std::vector<AntialiasVariant> all();
};

struct EnlargeVariant : PlainVariant<EnlargeVariant> {
    static constexpr bool IS_OF_SCENE = false;
    static constexpr const char* PATH = "enlarge";
};

// One entry shader: all defines that its passes may ask for besides the scene's.
struct ShaderFamily {
    std::string path;
    bool is_of_scene;
    std::vector<Defines> variants;
};

// All entry shaders.
std::vector<ShaderFamily> shader_families();

}  // namespace tarn
