// OpenEXR: linear radiance and named planes as 32-bit floats.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>

#include "core/error.h"
#include "image_io/file.h"
#include "image_io/formats.h"
#include "image_io/image_io.h"

namespace tarn {
namespace {

// The library's messages may run over several lines; ours never do.
std::string one_line(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    return message;
}

void write_planes(const std::string& name, int width, int height, const std::vector<ExrChannel>& channels,
                  const PictureNotes& notes) {
    Imf::Header header(width, height);
    for (const auto& [key, text] : notes) header.insert(key, Imf::StringAttribute(text));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer planes;
    for (const ExrChannel& channel : channels) {
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        char* base = reinterpret_cast<char*>(const_cast<float*>(channel.values.data()));
        planes.insert(channel.name,
                      Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * std::size_t(width)));
    }
    Imf::OutputFile file(name.c_str(), header);
    file.setFrameBuffer(planes);
    file.writePixels(height);
}

void check_channels(const std::filesystem::path& path, int width, int height,
                    const std::vector<ExrChannel>& channels) {
    check_picture_size(path, width, height);
    if (channels.empty()) throw Error("{}: a picture without channels cannot be written", path.string());
    const std::size_t pixel_count = std::size_t(width) * std::size_t(height);
    for (const ExrChannel& channel : channels) {
        if (channel.values.size() == pixel_count) continue;
        throw Error("{}: channel {} holds {} values, {} x {} pixels need {}", path.string(), channel.name,
                    channel.values.size(), width, height, pixel_count);
    }
}

const ExrChannel* find_channel(const std::vector<ExrChannel>& channels, const std::string& name) {
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&](const ExrChannel& channel) { return channel.name == name; });
    return found == channels.end() ? nullptr : &*found;
}

// A file of a kilobyte may claim planes of gigabytes: compression never shrinks them this much.
void check_claim(const std::filesystem::path& path, std::int64_t pixel_count, std::int64_t channel_count) {
    constexpr std::int64_t MAX_EXPANSION = 20'000;
    const std::int64_t claimed_bytes = pixel_count * channel_count * std::int64_t(sizeof(float));
    const auto file_bytes = std::int64_t(std::filesystem::file_size(path));
    if (claimed_bytes / MAX_EXPANSION > file_bytes) {
        throw Error("{}: the header claims {} bytes of pixels, the file holds {}", path.string(),
                    claimed_bytes, file_bytes);
    }
}

std::vector<ExrChannel> read_planes(const std::filesystem::path& path, int& width, int& height) {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t columns = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t rows = std::int64_t(window.max.y) - window.min.y + 1;
    check_picture_size(path, columns, rows);
    const Imf::ChannelList& list = file.header().channels();
    std::int64_t channel_count = 0;
    for (auto entry = list.begin(); entry != list.end(); ++entry) ++channel_count;
    check_claim(path, columns * rows, channel_count);
    width = int(columns);
    height = int(rows);

    std::vector<ExrChannel> channels;
    for (auto entry = list.begin(); entry != list.end(); ++entry) {
        if (entry.channel().xSampling != 1 || entry.channel().ySampling != 1) {
            throw Error("{}: channel {} is subsampled, only full resolution is read", path.string(),
                        entry.name());
        }
        channels.push_back({entry.name(), std::vector<float>(std::size_t(columns * rows))});
    }
    const std::int64_t first = window.min.y * columns + window.min.x;
    Imf::FrameBuffer planes;
    for (ExrChannel& channel : channels) {
        // The library indexes by absolute pixel: the base is where pixel (0, 0) would lie.
        char* base = reinterpret_cast<char*>(channel.values.data()) - first * std::int64_t(sizeof(float));
        planes.insert(channel.name,
                      Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * std::size_t(columns)));
    }
    file.setFrameBuffer(planes);
    file.readPixels(window.min.y, window.max.y);
    return channels;
}

}  // namespace

void write_exr(const std::filesystem::path& path, int width, int height,
               const std::vector<ExrChannel>& channels, const PictureNotes& notes) {
    check_channels(path, width, height, channels);
    write_whole(path, [&](const std::string& name) {
        try {
            write_planes(name, width, height, channels, notes);
        } catch (const std::exception& error) {
            throw Error("{}: cannot write: {}", path.string(), one_line(error.what()));
        }
    });
}

void write_exr(const std::filesystem::path& path, const Image& image, const PictureNotes& notes) {
    if (image.channels != 3)
        throw Error("{}: the picture has {} channels, 3 are needed", path.string(), image.channels);
    const char* names[3] = {"R", "G", "B"};
    std::vector<ExrChannel> channels;
    for (std::size_t c = 0; c < 3; ++c) {
        channels.push_back({names[c], std::vector<float>(image.pixel_count())});
        for (std::size_t i = 0; i < image.pixel_count(); ++i) channels[c].values[i] = image.values[3 * i + c];
    }
    write_exr(path, image.width, image.height, channels, notes);
}

PictureNotes read_exr_notes(const std::filesystem::path& path) {
    check_readable(path);
    try {
        const Imf::InputFile file(path.c_str());
        PictureNotes notes;
        for (auto entry = file.header().begin(); entry != file.header().end(); ++entry) {
            const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute());
            if (text != nullptr) notes.emplace_back(entry.name(), text->value());
        }
        return notes;
    } catch (const std::exception& error) {
        throw Error("{}: cannot read as OpenEXR: {}", path.string(), one_line(error.what()));
    }
}

std::vector<ExrChannel> read_exr_channels(const std::filesystem::path& path, int& width, int& height) {
    check_readable(path);
    try {
        return read_planes(path, width, height);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error("{}: cannot read as OpenEXR: {}", path.string(), one_line(error.what()));
    }
}

Image read_exr_radiance(const std::filesystem::path& path) {
    int width = 0;
    int height = 0;
    const std::vector<ExrChannel> channels = read_exr_channels(path, width, height);
    const ExrChannel* grey = find_channel(channels, "Y");
    const ExrChannel* planes[3] = {find_channel(channels, "R"), find_channel(channels, "G"),
                                   find_channel(channels, "B")};
    if (!planes[0] && !planes[1] && !planes[2]) std::fill_n(planes, 3, grey);
    Image image(width, height, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        if (!planes[c]) throw Error("{}: holds neither the channels R, G and B nor Y", path.string());
        for (std::size_t i = 0; i < image.pixel_count(); ++i) image.values[3 * i + c] = planes[c]->values[i];
    }
    return image;
}

}  // namespace tarn
