// tarn-noise FILE: writes the blue noise mask that Tarn reads. Exit status as tarn's: 0, 1 (cannot), 2
// (usage).
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

#include "blue_noise/mask_file.h"
#include "image_io/file.h"

namespace {

// Any seed would do. Another one changes all pictures that use the mask.
constexpr std::uint32_t SEED = 1;

void write_mask(const std::string& file) {
    const std::vector<unsigned char> bytes = tarn::noise::make_mask_file({}, SEED);
    tarn::write_whole(file, [&](const std::string& name) {
        std::ofstream stream(name, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    });
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 || argv[1][0] == '-') {
        std::fprintf(stderr, "usage: tarn-noise FILE\n");
        return 2;
    }
    try {
        write_mask(argv[1]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tarn-noise: %s\n", error.what());
        return 1;
    }
}
