// References that several tests of one program ask for: traced once, found again on disk by the rest.
//
// CTest gives every test a process of its own. The tracing would be most of their time, and the same each
// time.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "bench/hash.h"
#include "bench/reference_cache.h"
#include "core/error.h"
#include "gl/shader_source.h"

namespace tarn::test {

// Waits until no other process holds the file; lets go at its end, however the process ends.
class FileLock {
  public:
    explicit FileLock(const std::filesystem::path& file)
        : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
        if (descriptor_ < 0 || flock(descriptor_, LOCK_EX) != 0) throw Error("{}: no lock", file.string());
    }
    ~FileLock() { close(descriptor_); }
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    int descriptor_;
};

// build/.../test_references/PROGRAM/HASH. The hash is of this very program: one that is built anew, for
// whatever reason, starts without any, and takes away what the last one left.
inline std::filesystem::path make_reference_folder(const std::filesystem::path& of_program) {
    const std::string hash = hash_program(get_shader_root());
    for (const auto& entry : std::filesystem::directory_iterator(of_program)) {
        if (entry.is_directory() && entry.path().filename() != hash)
            std::filesystem::remove_all(entry.path());
    }
    return of_program / hash;
}

// render_reference, or the bits that it gave to this program before. Two tests never trace at a time: the one
// that waits may find what it needs. TARN_TEST_FRESH_REFERENCES (environment) traces all anew.
inline ReferenceResult find_reference(const World& world, const RayTracer& tracer,
                                      const ReferenceSettings& settings) {
    if (std::getenv("TARN_TEST_FRESH_REFERENCES") != nullptr)
        return render_reference(world, tracer, settings);
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").filename();
    const std::filesystem::path folder = std::filesystem::path(TARN_BUILD_DIR) / "test_references" / program;
    std::filesystem::create_directories(folder);
    const FileLock lock(folder / "lock");
    return ReferenceCache(make_reference_folder(folder)).get(world, tracer, settings);
}

}  // namespace tarn::test
