// Whole-file input and atomic output.
#include "image_io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "core/error.h"

namespace tarn {
namespace {

// Removes the temporary file unless it was renamed.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::filesystem::path& target) {
        static std::atomic<unsigned> serial = 0;
        name_ = fmt::format("{}.{}-{}.part", target.string(), ::getpid(), serial++);
    }
    ~TemporaryFile() {
        if (!renamed_) ::unlink(name_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& name() const { return name_; }

    // Some disks report that they are full only here.
    void flush(const std::filesystem::path& target) const {
        const int descriptor = ::open(name_.c_str(), O_WRONLY | O_CLOEXEC);
        const bool flushed = descriptor >= 0 && ::fsync(descriptor) == 0;
        const int reason = errno;
        if (descriptor >= 0) ::close(descriptor);
        if (!flushed) throw Error("{}: cannot write: {}", target.string(), std::strerror(reason));
    }

    void rename_to(const std::filesystem::path& target) {
        if (::rename(name_.c_str(), target.c_str()) != 0) {
            throw Error("{}: cannot write: {}", target.string(), std::strerror(errno));
        }
        renamed_ = true;
    }

  private:
    std::string name_;
    bool renamed_ = false;
};

void check_writable(const std::filesystem::path& path) {
    const std::filesystem::path folder =
        path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw Error("{}: is a folder, not a file", path.string());
    // A file that is renamed to the name of a pipe or a device would take its place.
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
        throw Error("{}: is not a regular file", path.string());
    if (!std::filesystem::is_directory(folder, ignored)) {
        throw Error("{}: cannot write: there is no folder {}", path.string(), folder.string());
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        throw Error("{}: cannot write into {}: {}", path.string(), folder.string(), std::strerror(errno));
    }
}

}  // namespace

void check_picture_size(const std::filesystem::path& path, std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1) {
        throw Error("{}: the picture is {} x {} pixels, at least 1 x 1 is needed", path.string(), width,
                    height);
    }
    if (width > MAX_PIXEL_COUNT / height) {
        throw Error("{}: the picture is {} x {} pixels, the limit is {} in all", path.string(), width, height,
                    MAX_PIXEL_COUNT);
    }
}

std::vector<unsigned char> load_file(const std::filesystem::path& path) {
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (status.type() == std::filesystem::file_type::not_found)
        throw Error("{}: no such file", path.string());
    if (std::filesystem::is_directory(status)) throw Error("{}: is a folder, not a file", path.string());
    if (!std::filesystem::is_regular_file(status)) throw Error("{}: is not a regular file", path.string());
    errno = 0;
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = stream ? std::streamoff(stream.tellg()) : -1;
    if (size < 0) throw Error("{}: cannot read: {}", path.string(), std::strerror(errno));
    std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), size);
    if (stream.gcount() != size)
        throw Error("{}: cannot read: {} of {} bytes", path.string(), stream.gcount(), size);
    return bytes;
}

void write_whole(const std::filesystem::path& path, const std::function<void(const std::string&)>& write) {
    check_writable(path);
    TemporaryFile temporary(path);
    write(temporary.name());
    temporary.flush(path);
    temporary.rename_to(path);
}

}  // namespace tarn
