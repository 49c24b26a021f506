// Pictures on disk: exact round trips, foreign variants, and one clear line for everything that can be wrong.
#include "image_io/image_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <random>

#include "core/error.h"

namespace tarn {
namespace {

namespace fs = std::filesystem;

class ImageIo : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() /
                  (std::string("tarn_image_io_") + test->name() + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string write_bytes(const char* name, const std::string& bytes) const {
        const fs::path path = folder_ / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }

    static std::string load_bytes(const fs::path& path) {
        std::ifstream stream(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }

    std::size_t file_count() const {
        return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

Image ramp(int width, int height) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = 0.37f * float(i) - 2.0f;
    return image;
}

// Runs `action` and returns the message of its Error: one line that names `path`.
template <class Action>
std::string error_of(const fs::path& path, Action action) {
    try {
        action();
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_NE(message.find(path.string()), std::string::npos) << message;
        return message;
    }
    ADD_FAILURE() << path << ": no Error";
    return {};
}

TEST_F(ImageIo, exr_returns_what_was_written_to_the_bit) {
    Image image = ramp(13, 7);
    image.values[3] = std::numeric_limits<float>::infinity();
    image.values[5] = 1e-42f;
    write_exr(folder_ / "a.exr", image);
    const Image read = read_radiance(folder_ / "a.exr");
    EXPECT_EQ(read.width, 13);
    EXPECT_EQ(read.height, 7);
    EXPECT_EQ(read.channels, 3);
    EXPECT_EQ(read.values, image.values);
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageIo, exr_keeps_named_channels_apart) {
    const std::vector<ExrChannel> channels = {
        {"variance.R", {1, 2, 3, 4, 5, 6}}, {"R", {7, 8, 9, 10, 11, 12}}, {"depth", {0, 0, 0, 0, 0, 1}}};
    write_exr(folder_ / "a.exr", 3, 2, channels);
    int width = 0;
    int height = 0;
    const auto read = read_exr_channels(folder_ / "a.exr", width, height);
    EXPECT_EQ(width, 3);
    EXPECT_EQ(height, 2);
    ASSERT_EQ(read.size(), 3u);
    for (const ExrChannel& written : channels) {
        const auto found =
            std::find_if(read.begin(), read.end(), [&](auto& c) { return c.name == written.name; });
        ASSERT_NE(found, read.end()) << written.name;
        EXPECT_EQ(found->values, written.values);
    }
    error_of(folder_ / "a.exr", [&] { read_radiance(folder_ / "a.exr"); });  // R without G and B
}

TEST_F(ImageIo, exr_replaces_an_older_file) {
    write_exr(folder_ / "a.exr", ramp(4, 4));
    write_exr(folder_ / "a.exr", ramp(2, 3));
    EXPECT_EQ(read_radiance(folder_ / "a.exr").height, 3);
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageIo, exr_reads_half_luminance_and_windows_that_do_not_start_at_zero) {
    const fs::path path = folder_ / "half.exr";
    const Imath::Box2i window(Imath::V2i(-3, 5), Imath::V2i(-2, 7));
    Imf::Header header(window, window);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    const std::vector<half> values = {half(0.5f), half(1.0f), half(2.0f),
                                      half(4.0f), half(8.0f), half(16.0f)};
    Imf::FrameBuffer planes;
    char* base = reinterpret_cast<char*>(const_cast<half*>(values.data())) - std::ptrdiff_t(5 * 2 - 3) * 2;
    planes.insert("Y", Imf::Slice(Imf::HALF, base, 2, 4));
    {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(planes);
        file.writePixels(3);
    }
    const Image image = read_radiance(path);
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 3);
    EXPECT_EQ(image.pixel(0, 0)[0], 0.5f);
    EXPECT_EQ(image.pixel(1, 0)[1], 1.0f);
    EXPECT_EQ(image.pixel(1, 2)[2], 16.0f);
}

TEST_F(ImageIo, hdr_is_read_from_the_top_row) {
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n";
    bytes += std::string("\x80\x40\x20\x81", 4);  // 128, 64, 32 with exponent 129: 1, 0.5, 0.25
    bytes += std::string("\x80\x80\x80\x83", 4);  // exponent 131: 4
    const Image image = read_radiance(write_bytes("a.hdr", bytes));
    ASSERT_EQ(image.pixel_count(), 2u);
    EXPECT_EQ(image.pixel(0, 0)[0], 1.0f);
    EXPECT_EQ(image.pixel(0, 0)[1], 0.5f);
    EXPECT_EQ(image.pixel(0, 0)[2], 0.25f);
    EXPECT_EQ(image.pixel(0, 1)[2], 4.0f);
}

TEST_F(ImageIo, png_keeps_all_256_values_and_clamps_others) {
    Image image(256, 2, 3);
    for (int x = 0; x < 256; ++x) {
        for (int c = 0; c < 3; ++c) image.pixel(x, 0)[c] = float(x) / 255.0f;
    }
    const float odd[] = {-1.0f, 2.0f, std::nanf(""), std::numeric_limits<float>::infinity()};
    for (int x = 0; x < 4; ++x) image.pixel(x, 1)[0] = odd[x];
    write_png(folder_ / "a.png", image);
    const Image read = read_png(folder_ / "a.png");
    ASSERT_EQ(read.pixel_count(), image.pixel_count());
    for (int x = 0; x < 256; ++x) EXPECT_EQ(read.pixel(x, 0)[1], float(x) / 255.0f);
    EXPECT_EQ(read.pixel(0, 1)[0], 0.0f);
    EXPECT_EQ(read.pixel(1, 1)[0], 1.0f);
    EXPECT_EQ(read.pixel(2, 1)[0], 0.0f);
    EXPECT_EQ(read.pixel(3, 1)[0], 1.0f);
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageIo, missing_files_folders_and_foreign_files_are_named) {
    const fs::path missing = folder_ / "missing.exr";
    EXPECT_NE(error_of(missing, [&] { read_radiance(missing); }).find("no such file"), std::string::npos);
    error_of(missing, [&] { read_png(missing); });
    int width = 0;
    int height = 0;
    error_of(missing, [&] { read_exr_channels(missing, width, height); });
    EXPECT_NE(error_of(folder_, [&] { read_radiance(folder_); }).find("folder"), std::string::npos);
    error_of(folder_, [&] { read_png(folder_); });
    error_of(folder_, [&] { read_exr_channels(folder_, width, height); });
    for (const std::string& bytes : {std::string(), std::string("v/1"), std::string("hello, this is text")}) {
        const fs::path path = write_bytes("foreign", bytes);
        error_of(path, [&] { read_radiance(path); });
        error_of(path, [&] { read_png(path); });
        error_of(path, [&] { read_exr_channels(path, width, height); });
    }
}

TEST_F(ImageIo, truncated_files_are_errors_at_every_length) {
    write_exr(folder_ / "a.exr", ramp(9, 40));
    write_png(folder_ / "a.png", ramp(9, 5));
    const std::string exr = load_bytes(folder_ / "a.exr");
    for (std::size_t length = 0; length < exr.size(); length += 7) {
        const fs::path path = write_bytes("cut.exr", exr.substr(0, length));
        error_of(path, [&] { read_radiance(path); });
    }
    const std::string png = load_bytes(folder_ / "a.png");
    for (std::size_t length = 0; length + 16 < png.size(); ++length) {  // the last 16 bytes hold no pixels
        const fs::path path = write_bytes("cut.png", png.substr(0, length));
        error_of(path, [&] { read_png(path); });
    }
}

TEST_F(ImageIo, damaged_files_are_read_or_refused) {
    write_exr(folder_ / "a.exr", ramp(9, 40));
    write_png(folder_ / "a.png", ramp(9, 5));
    std::mt19937 random(1);
    for (const char* name : {"a.exr", "a.png"}) {
        const std::string whole = load_bytes(folder_ / name);
        int refused = 0;
        for (int trial = 0; trial < 300; ++trial) {
            std::string bytes = whole;
            for (int i = 0; i < 3; ++i) bytes[random() % bytes.size()] = char(random());
            const fs::path path = write_bytes("damaged", bytes);
            try {
                const Image image = name[2] == 'e' ? read_radiance(path) : read_png(path);
                EXPECT_EQ(image.values.size(), image.pixel_count() * 3);
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
                ++refused;
            }
        }
        EXPECT_GT(refused, 0) << name;
    }
}

TEST_F(ImageIo, headers_that_lie_about_the_size_cost_no_memory) {
    write_png(folder_ / "a.png", ramp(2, 2));
    std::string png = load_bytes(folder_ / "a.png");
    png.replace(16, 8,
                std::string("\x00\x00\xff\xff\x00\x00\x0f\xff", 8));  // 65535 x 4095, without the checksum
    const fs::path lying_png = write_bytes("lie.png", png);
    error_of(lying_png, [&] { read_png(lying_png); });
    const fs::path lying_hdr =
        write_bytes("lie.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\nxxxx");
    error_of(lying_hdr, [&] { read_radiance(lying_hdr); });

    write_exr(folder_ / "a.exr", ramp(2, 2));
    std::string exr = load_bytes(folder_ / "a.exr");
    const std::size_t window = exr.find("box2i", exr.find("dataWindow")) + 6 + 4;
    for (const std::string& limits : {std::string("\xff\x3f\x00\x00\xff\x3f\x00\x00", 8),
                                      std::string("\xff\xff\xff\x7f\xff\xff\xff\x7f", 8)}) {
        exr.replace(window + 8, 8, limits);
        const fs::path path = write_bytes("lie.exr", exr);
        error_of(path, [&] { read_radiance(path); });
    }
}

TEST_F(ImageIo, sizes_that_make_no_picture_are_refused) {
    const fs::path path = folder_ / "a.exr";
    error_of(path, [&] { write_exr(path, Image(0, 4, 3)); });
    error_of(path, [&] { write_exr(path, 4, -1, {{"R", {}}}); });
    error_of(path, [&] { write_exr(path, 1 << 15, 1 << 14, {{"R", {}}}); });
    error_of(path, [&] { write_exr(path, 2, 2, {{"R", {1, 2, 3}}}); });
    error_of(path, [&] { write_exr(path, 2, 2, {}); });
    error_of(path, [&] { write_exr(path, Image(2, 2, 1)); });
    error_of(path, [&] { write_png(path, Image(2, 0, 3)); });
    error_of(path, [&] { write_png(path, Image(2, 2, 4)); });
    EXPECT_EQ(file_count(), 0u);
}

TEST_F(ImageIo, places_that_cannot_be_written_are_named) {
    for (const fs::path& path : {folder_ / "missing" / "a", folder_, fs::path("/proc/a")}) {
        error_of(path, [&] { write_exr(path, ramp(2, 2)); });
        error_of(path, [&] { write_png(path, ramp(2, 2)); });
    }
    EXPECT_EQ(file_count(), 0u);
}

TEST_F(ImageIo, a_read_only_folder_is_named) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write into read-only folders";
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    error_of(folder_ / "a.exr", [&] { write_exr(folder_ / "a.exr", ramp(2, 2)); });
    error_of(folder_ / "a.png", [&] { write_png(folder_ / "a.png", ramp(2, 2)); });
    fs::permissions(folder_, fs::perms::owner_all);
}

// A limit on the size of files behaves as a disk that fills up while a file is being written.
TEST_F(ImageIo, a_full_disk_leaves_the_old_file_and_no_part_of_the_new_one) {
    std::mt19937 random(2);
    Image noise(64, 64, 3);
    for (float& value : noise.values) value = float(random()) / 4e9f;
    write_exr(folder_ / "a.exr", ramp(2, 2));
    write_png(folder_ / "a.png", ramp(2, 2));
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 4096;
    setrlimit(RLIMIT_FSIZE, &small);
    error_of(folder_ / "a.exr", [&] { write_exr(folder_ / "a.exr", noise); });
    error_of(folder_ / "a.png", [&] { write_png(folder_ / "a.png", noise); });
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(file_count(), 2u);
    EXPECT_EQ(read_radiance(folder_ / "a.exr").width, 2);
    EXPECT_EQ(read_png(folder_ / "a.png").width, 2);
}

}  // namespace
}  // namespace tarn
