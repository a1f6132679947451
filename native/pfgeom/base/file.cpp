#include "pfgeom/base/file.h"

#include "pfgeom/base/error.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace pfgeom {
namespace {

// Linux moves at most 2^31 - 4096 bytes a call; a smaller piece costs nothing.
constexpr std::size_t kPiece = std::size_t{1} << 28;

[[noreturn]] void fail(const std::string& what, const std::string& path, int error) {
    throw IoError(what + " '" + path + "': " + std::generic_category().message(error));
}

/// A descriptor that is closed when it goes.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    explicit operator bool() const { return fd_ >= 0; }
    int get() const { return fd_; }
    int close() { return fd_ < 0 ? 0 : ::close(std::exchange(fd_, -1)); }

  private:
    int fd_;
};

/// Calls `move` (read or write) until `size` bytes are through; false with errno, 0 if the file ended.
template <class Move>
bool transfer(std::size_t size, Move move) {
    for (std::size_t done = 0; done < size;) {
        const ssize_t n = move(done, std::min(size - done, kPiece));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            if (n == 0) errno = 0;
            return false;
        }
        done += static_cast<std::size_t>(n);
    }
    return true;
}

/// Where `path` leads through symbolic links, so that a rename replaces the file and not the link.
/// Refuses what is there and is no regular file: a rename would take a device's or a pipe's place.
std::string target_of(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) return path;
    if (!std::filesystem::is_regular_file(status))
        throw IoError("cannot write '" + path + "': not a regular file");
    const auto resolved = std::filesystem::canonical(path, error);
    return error ? path : resolved.string();
}

/// A fresh file beside `target`, removed again unless `keep` was called.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& target) : name_(name_beside(target)), file_(create(name_)) {
        if (!file_) fail("cannot write", target, errno);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!kept_) ::unlink(name_.c_str());
    }

    bool write(std::span<const std::uint8_t> bytes) {
        return transfer(bytes.size(),
                        [&](std::size_t done, std::size_t n) {
                            return ::write(file_.get(), bytes.data() + done, n);
                        }) &&
               ::fsync(file_.get()) == 0 && file_.close() == 0;
    }
    bool rename_to(const std::string& target) {
        kept_ = std::rename(name_.c_str(), target.c_str()) == 0;
        return kept_;
    }

  private:
    static std::string name_beside(const std::string& target) {
        static std::atomic<unsigned> counter{0};
        return target + ".part" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
    }
    static int create(const std::string& name) {
        return ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }

    std::string name_;
    Descriptor file_;
    bool kept_ = false;
};

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, const Limits& limits) {
    // Non-blocking: opening a pipe must not wait for its writer.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    struct stat info {};
    if (!file || ::fstat(file.get(), &info) != 0) fail("cannot open", path, errno);
    if (!S_ISREG(info.st_mode)) throw IoError("cannot read '" + path + "': not a regular file");
    const auto size = static_cast<std::uint64_t>(info.st_size);
    if (size > limits.file_bytes)
        throw IoError("cannot read '" + path + "': " + std::to_string(size) + " bytes, the limit is " +
                      std::to_string(limits.file_bytes));

    std::vector<std::uint8_t> bytes(size);
    const bool whole = transfer(bytes.size(), [&](std::size_t done, std::size_t n) {
        return ::read(file.get(), bytes.data() + done, n);
    });
    if (!whole && errno == 0) throw IoError("cannot read '" + path + "': it became shorter meanwhile");
    if (!whole) fail("cannot read", path, errno);
    return bytes;
}

void write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
    const std::string target = target_of(path);
    TemporaryFile file(target);
    if (!file.write(bytes) || !file.rename_to(target)) fail("cannot write", path, errno);
}

}  // namespace pfgeom
