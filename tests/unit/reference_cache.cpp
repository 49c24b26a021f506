// The cache of references: what differs never hits, what is damaged is made anew, a closed folder loses
// nothing.
#include "bench/reference_cache.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/log.h"
#include "support/process.h"
#include "support/toy_scenes.h"

namespace tarn::test {
namespace {

Scene make_scene(float albedo = 0.5f) {
    ToyScene toy;
    toy.add_quad(toy.add_material(lambert_material(glm::vec3(albedo))), {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    return toy.scene;
}

struct Toy {
    explicit Toy(const Scene& toy_scene = make_scene())
        : scene(toy_scene), world(build_world(scene)), tracer(create_embree_tracer(world)) {
        set_quiet(true);
        settings.width = 16;
        settings.height = 8;
        settings.spp = 4;
        settings.direct_only = true;
        settings.camera = look_at(world, {0, 2, 2}, {0, 0, 0}, 40.0, 2.0);
    }
    ReferenceResult get(const ReferenceCache& cache) const { return cache.get(world, *tracer, settings); }
    std::string key() const { return describe_reference_key(world, settings); }

    Scene scene;
    World world;
    std::unique_ptr<RayTracer> tracer;
    ReferenceSettings settings;
};

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& extension) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == extension) files.push_back(entry.path());
    }
    return files;
}

TEST(ReferenceCache, ASecondLookFindsTheSameBits) {
    const TemporaryFolder folder;
    const ReferenceCache cache(folder.path());
    const Toy toy;
    const ReferenceResult rendered = toy.get(cache);
    const ReferenceResult found = cache.load(toy.key());
    EXPECT_EQ(found.radiance.values, rendered.radiance.values);
    EXPECT_EQ(found.variance.values, rendered.variance.values);
    EXPECT_EQ(found.spp, rendered.spp);
    EXPECT_EQ(found.relative_error, rendered.relative_error);
}

TEST(ReferenceCache, EveryChangeIsAnotherKey) {
    const Toy toy;
    std::vector<std::string> keys = {toy.key()};
    const std::vector<std::function<void(ReferenceSettings&)>> changes = {
        [](ReferenceSettings& s) { ++s.width; },
        [](ReferenceSettings& s) { ++s.height; },
        [](ReferenceSettings& s) { ++s.spp; },
        [](ReferenceSettings& s) { ++s.seed; },
        [](ReferenceSettings& s) { s.direct_only = false; },
        [](ReferenceSettings& s) { s.relative_error = 0.1; },
        [](ReferenceSettings& s) { s.box_pixel_filter = true; },
        [](ReferenceSettings& s) { s.light_tree = true; },
        [](ReferenceSettings& s) { s.strategy = LightStrategy::BRDF_ONLY; },
        [](ReferenceSettings& s) { s.camera.position.x = std::nextafter(s.camera.position.x, 10.0f); },
        [](ReferenceSettings& s) { s.camera.forward.z += 1e-6f; },
        [](ReferenceSettings& s) { s.camera.orthographic = true; },
    };
    for (const auto& change : changes) {
        Toy changed;
        change(changed.settings);
        keys.push_back(changed.key());
    }
    keys.push_back(Toy(make_scene(0.51f)).key());
    Scene moved = make_scene();
    moved.nodes.front().matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 1e-3));
    keys.push_back(Toy(moved).key());
    std::sort(keys.begin(), keys.end());
    EXPECT_EQ(std::unique(keys.begin(), keys.end()), keys.end());
    EXPECT_EQ(Toy().key(), toy.key());
}

TEST(ReferenceCache, ADamagedEntryIsMadeAnew) {
    const TemporaryFolder folder;
    const ReferenceCache cache(folder.path());
    const Toy toy;
    const ReferenceResult rendered = toy.get(cache);
    for (const char* extension : {".exr", ".json"}) {
        const auto files = files_in(folder.path(), extension);
        ASSERT_EQ(files.size(), 1u);
        std::filesystem::resize_file(files[0], std::filesystem::file_size(files[0]) / 2);
        EXPECT_TRUE(cache.load(toy.key()).radiance.empty()) << extension;
        EXPECT_EQ(toy.get(cache).radiance.values, rendered.radiance.values);
        EXPECT_FALSE(cache.load(toy.key()).radiance.empty()) << extension;
    }
}

// One bit of a picture may flip without making it unreadable.
TEST(ReferenceCache, APictureThatIsNotWhatWasWrittenIsMadeAnew) {
    const TemporaryFolder folder;
    const ReferenceCache cache(folder.path());
    const Toy toy;
    Toy other;
    other.settings.seed = 5;
    toy.get(cache);
    const auto file = files_in(folder.path(), ".exr").at(0);
    std::filesystem::rename(file, folder.path() / "mine.exr");
    other.get(cache);
    for (const auto& exr : files_in(folder.path() / "references", ".exr"))
        std::filesystem::copy_file(exr, file);
    EXPECT_TRUE(cache.load(toy.key()).radiance.empty());
}

TEST(ReferenceCache, AnEntryOfAnotherKeyNeverHits) {
    const TemporaryFolder folder;
    const ReferenceCache cache(folder.path());
    const Toy toy;
    cache.store("another key", toy.get(ReferenceCache({})));
    // As if both keys had one hash.
    const auto note = files_in(folder.path(), ".json").at(0), picture = files_in(folder.path(), ".exr").at(0);
    cache.store(toy.key(), toy.get(ReferenceCache({})));
    for (const char* extension : {".json", ".exr"}) {
        const auto& from = extension == std::string(".json") ? note : picture;
        for (const auto& file : files_in(folder.path(), extension)) {
            if (file != from)
                std::filesystem::copy_file(from, file, std::filesystem::copy_options::overwrite_existing);
        }
    }
    EXPECT_TRUE(cache.load(toy.key()).radiance.empty());
}

TEST(ReferenceCache, AFolderThatCannotBeWrittenLosesNothing) {
    const Toy toy;
    const ReferenceResult result = toy.get(ReferenceCache("/proc/no_such_folder"));
    EXPECT_EQ(result.spp, toy.settings.spp);
    EXPECT_FALSE(result.radiance.empty());
}

}  // namespace
}  // namespace tarn::test
