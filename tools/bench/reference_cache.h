// References on disk: path-traced once, found again by everything that went into them.
#pragma once

#include <filesystem>
#include <string>

#include "reference/reference.h"

namespace tarn {

// All that decides a reference's bits, as text: the world's content, camera, size, sampling, the version of
// the code and of the ray library.
std::string describe_reference_key(const World& world, const ReferenceSettings& settings);

// Where references are kept: $TARN_CACHE_DIR, else $XDG_CACHE_HOME/tarn, else ~/.cache/tarn. Empty where none
// of these is set.
std::filesystem::path default_cache_folder();

class ReferenceCache {
  public:
    explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // The reference for these settings: from the cache, or rendered (with progress) and kept. An entry that
    // is damaged is warned about and made anew; a folder that cannot be written costs a warning. A reference
    // that was cancelled is returned and not kept.
    ReferenceResult get(const World& world, const RayTracer& tracer, const ReferenceSettings& settings) const;

    // The entry of a key, or no radiance where there is none or none that is whole.
    ReferenceResult load(const std::string& key) const;

    // Throws Error where it cannot be written.
    void store(const std::string& key, const ReferenceResult& result) const;

  private:
    std::filesystem::path file(const std::string& key, const char* ending) const;

    std::filesystem::path folder_;
};

}  // namespace tarn
