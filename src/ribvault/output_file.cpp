#include "ribvault/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "ribvault/error.hpp"

namespace ribvault {

namespace fs = std::filesystem;

/// One temporary name in the list that discard_pending_files() walks. Nodes are never freed nor reused: a signal
/// handler may be reading one at any time. They cost about a hundred bytes a file.
struct AtomicFile::Pending {
    const std::string name;
    std::atomic<bool> active{true};
    Pending* next = nullptr;
    explicit Pending(std::string n) : name(std::move(n)) {}

    static std::atomic<Pending*> first;
    static std::atomic<bool> discarded;  ///< the program ends
    static Pending* add(std::string name) {
        auto* node = new Pending(std::move(name));
        node->next = first.load();
        while (!first.compare_exchange_weak(node->next, node)) {}
        return node;
    }
};

std::atomic<AtomicFile::Pending*> AtomicFile::Pending::first{nullptr};
std::atomic<bool> AtomicFile::Pending::discarded{false};

namespace {

constexpr std::size_t buffer_size = 1 << 16;

constexpr int most_links = 40;  // as the system follows

/// Where a symbolic link points.
fs::path target_of(const fs::path& link) {
    std::error_code none;
    const fs::path to = fs::read_symlink(link, none);
    return to.is_absolute() ? to : link.parent_path() / to;
}

/// The number of a descriptor of this program that the path stands for, as /dev/stdout or /dev/fd/3 do; -1: none.
int descriptor_named(fs::path path) {
    std::error_code none;
    for (int links = 0; links < most_links; ++links, path = target_of(path)) {
        const std::string folder = fs::canonical(path.parent_path(), none).string(), name = path.filename().string();
        if (!none && (folder == "/proc/self/fd" || folder == "/proc/" + std::to_string(::getpid()) + "/fd") &&
            !name.empty() && name.find_first_not_of("0123456789") == std::string::npos && name.size() < 10)
            return std::stoi(name);
        if (!fs::is_symlink(path, none)) return -1;
    }
    return -1;
}

int open_retrying(const char* name, int flags, mode_t mode = 0) {
    int descriptor;
    do descriptor = ::open(name, flags | O_CLOEXEC, mode);
    while (descriptor < 0 && errno == EINTR);
    return descriptor;
}

std::string_view remedy_for(int error_number) {
    switch (error_number) {
        case ENOENT:
        case ENOTDIR: return "create the folder first, or choose another name";
        case EACCES:
        case EPERM:
        case EROFS: return "choose a place that you may write to";
        case ENOSPC:
        case EDQUOT: return "make room, or choose another disk";
        case EISDIR: return "give the name of a file";
        case EMFILE: return "raise the limit on open files (ulimit -n)";
        case ESPIPE: return "choose a file on a disk";
        default: return "choose another name";
    }
}

}  // namespace

fs::path follow_links(fs::path path) {
    std::error_code none;
    for (int links = 0; links < most_links && fs::is_symlink(path, none); ++links) path = target_of(path);
    return path;
}

void AtomicFile::fail(int error_number, std::string_view remedy) const {
    if (remedy.empty()) remedy = remedy_for(error_number);
    throw Error(ErrorKind::cannot_write, "cannot write " + target_.string() + ": " +
                                             std::generic_category().message(error_number) + "; " +
                                             std::string(remedy));
}

AtomicFile::AtomicFile(fs::path target, bool durable)
    : target_(std::move(target)), final_(follow_links(target_)), durable_(durable) {
    if (const int own = descriptor_named(target_); own >= 0) {
        descriptor_ = ::fcntl(own, F_DUPFD_CLOEXEC, 3);
        if (descriptor_ < 0) fail(errno);
        buffer_.reserve(buffer_size);
        return;
    }
    struct stat there {};
    std::error_code none;
    if (!final_.has_filename()) fail(EISDIR);
    if (fs::is_symlink(final_, none)) fail(ELOOP);
    if (::stat(final_.c_str(), &there) == 0) {
        if (S_ISDIR(there.st_mode)) fail(EISDIR);
        if (!S_ISREG(there.st_mode)) {
            descriptor_ = open_retrying(final_.c_str(), O_WRONLY);
            if (descriptor_ < 0) fail(errno);
        } else if (::access(final_.c_str(), W_OK) != 0) {
            fail(errno);
        }
    }
    if (descriptor_ < 0) {
        open_beside_target();
        if (S_ISREG(there.st_mode)) (void)!::fchmod(descriptor_, there.st_mode & 07777);
    }
    buffer_.reserve(buffer_size);
}

void AtomicFile::open_beside_target() {
    static std::atomic<unsigned> serial{0};
    // A name of its own, not one made from the target's, which may be as long as names can be.
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const fs::path name = final_.parent_path() /
                              (".ribvault-" + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".part");
        // Listed before it exists, so that no signal finds a file that is not listed; the O_EXCL below keeps a file of
        // the same name that is not ours, and then the node must not stay active.
        Pending* pending = Pending::add(name.string());
        descriptor_ = open_retrying(name.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (descriptor_ >= 0) {
            pending_ = pending;
            if (Pending::discarded) ::unlink(name.c_str());  // made after the handler had come by
            return;
        }
        pending->active = false;
        if (errno != EEXIST) fail(errno);
    }
    fail(EEXIST, "remove the files .ribvault-*.part that an earlier run left in that folder");
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      final_(std::move(other.final_)),
      pending_(std::exchange(other.pending_, nullptr)),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      durable_(other.durable_) {}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    if (pending_) {
        ::unlink(pending_->name.c_str());
        std::exchange(pending_, nullptr)->active = false;
    }
}

void AtomicFile::write_all(const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t written = ::write(descriptor_, bytes, count);
        if (written < 0) {
            if (errno == EINTR) continue;
            fail(errno);
        }
        bytes += written, count -= static_cast<std::size_t>(written);
    }
}

void AtomicFile::flush() {
    write_all(buffer_.data(), buffer_.size());
    buffer_.clear();
}

void AtomicFile::write(std::string_view bytes) {
    if (buffer_.size() + bytes.size() > buffer_size) flush();
    if (bytes.size() > buffer_size)
        write_all(bytes.data(), bytes.size());
    else
        buffer_ += bytes;
}

void AtomicFile::overwrite(std::uint64_t offset, std::string_view bytes) {
    flush();
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0) {
            if (errno == EINTR) continue;
            fail(errno);
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
}

void AtomicFile::finish() {
    if (descriptor_ < 0) return;
    flush();
    buffer_.shrink_to_fit();
    // Devices and some file systems know no fsync; that is no failure to write.
    if (pending_ && durable_ && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOSYS) fail(errno);
    if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
}

void AtomicFile::commit() {
    finish();
    if (!pending_) return;
    if (std::rename(pending_->name.c_str(), final_.c_str()) != 0) fail(errno);
    std::exchange(pending_, nullptr)->active = false;
}

void discard_pending_files() noexcept {
    const int saved = errno;
    AtomicFile::Pending::discarded = true;
    for (const AtomicFile::Pending* node = AtomicFile::Pending::first.load(); node; node = node->next)
        if (node->active) ::unlink(node->name.c_str());
    errno = saved;
}

}  // namespace ribvault
