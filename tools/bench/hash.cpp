#include "bench/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

#include "core/error.h"
#include "image_io/file.h"

namespace tarn {
namespace {

std::string format_hash(const XXH128_hash_t& hash) {
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

Hasher::Hasher() : state_(XXH3_createState()) {
    if (state_ == nullptr) throw Error("no memory for a hash");
    XXH3_128bits_reset(state_);
}

Hasher::~Hasher() {
    XXH3_freeState(state_);
}

void Hasher::add_bytes(const void* bytes, std::size_t size) {
    if (size > 0) XXH3_128bits_update(state_, bytes, size);
}

std::string Hasher::text() const {
    return format_hash(XXH3_128bits_digest(state_));
}

std::string hash_bytes(std::span<const unsigned char> bytes) {
    return format_hash(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string hash_text(std::string_view text) {
    return format_hash(XXH3_128bits(text.data(), text.size()));
}

std::string hash_program(const std::filesystem::path& shader_folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shader_folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    Hasher hasher;
    hasher.add(load_file("/proc/self/exe"));
    for (const std::filesystem::path& file : files) hasher.add(load_file(file));
    return hasher.text();
}

}  // namespace tarn
