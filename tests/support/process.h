// Runs programs as a person would: arguments in, exit status and both streams out.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace tarn::test {

// A folder that vanishes with the test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "tarn_test_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::string file(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct ProcessResult {
    int status = -1;  // exit status; -1 when a signal ended the process
    std::string out;
    std::string err;

    // Lines on the error output but those of progress, which a slow machine alone prints.
    long error_lines() const {
        std::istringstream lines(err);
        long count = 0;
        for (std::string line; std::getline(lines, line);) count += line.ends_with(" s left") ? 0 : 1;
        return count;
    }
};

// A running program; its streams go to files, so that no pipe can fill up.
class Process {
  public:
    explicit Process(const std::vector<std::string>& arguments) {
        std::vector<char*> argv;
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        const std::string out = folder_.file("out"), err = folder_.file("err");
        id_ = fork();
        if (id_ != 0) return;
        dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600), STDOUT_FILENO);
        dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600), STDERR_FILENO);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    ~Process() {
        if (id_ <= 0) return;
        kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const { kill(id_, signal); }

    // Waits until `condition` holds or `patience` is over or the process ended; returns whether it held.
    template <class Condition>
    bool wait_until(const Condition& condition, std::chrono::seconds patience) {
        const auto end = std::chrono::steady_clock::now() + patience;
        while (!condition()) {
            if (has_ended() || std::chrono::steady_clock::now() > end) return condition();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return true;
    }

    // What it has said on stderr so far.
    std::string error_text() const { return read_text(folder_.file("err")); }

    // Waits for the end.
    ProcessResult finish() {
        if (id_ > 0) waitpid(id_, &wait_status_, 0);
        id_ = -1;
        ProcessResult result;
        if (WIFEXITED(wait_status_)) result.status = WEXITSTATUS(wait_status_);
        result.out = read_text(folder_.file("out"));
        result.err = read_text(folder_.file("err"));
        return result;
    }

  private:
    bool has_ended() {
        if (id_ > 0 && waitpid(id_, &wait_status_, WNOHANG) == id_) id_ = -1;
        return id_ <= 0;
    }

    TemporaryFolder folder_;
    pid_t id_ = -1;
    int wait_status_ = 0;
};

inline ProcessResult run_process(const std::vector<std::string>& arguments) {
    return Process(arguments).finish();
}

// The program under test.
inline std::string tarn_program() {
    return TARN_BUILD_DIR "/tarn";
}

inline ProcessResult run_tarn(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), tarn_program());
    return run_process(arguments);
}

}  // namespace tarn::test
