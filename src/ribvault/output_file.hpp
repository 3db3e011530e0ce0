// Files that appear under their names complete or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ribvault {

/// A file being written: under a temporary name in the folder of its target until commit(). Destroyed before that, it
/// leaves nothing behind, and a file that was already there is untouched. A target that exists and is no regular file
/// (a device, a pipe), or a descriptor of this program (/dev/stdout, /dev/fd/3), is written directly.
///
/// Every failure (no folder, no permission, disk full) throws Error (cannot_write) with the target's name and the
/// system's reason, at the latest in finish(); the temporary file is then removed when the object is destroyed.
/// One object is for one thread at a time; different objects may be used by different threads.
///
///     AtomicFile gcode("part.gcode"), report("part.json");
///     gcode.write(...), report.write(...);
///     gcode.finish(), report.finish();  // all that can fail for want of space has failed by now
///     gcode.commit(), report.commit();
class AtomicFile {
public:
    /// `durable`: finish() waits until the disk has the data. Without it, many small files are much faster.
    explicit AtomicFile(std::filesystem::path target, bool durable = true);
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;

    void write(std::string_view bytes);

    /// Replaces bytes already written. Fails on pipes and terminals.
    void overwrite(std::uint64_t offset, std::string_view bytes);

    /// Hands everything to the system and closes the file, still under its temporary name. No write after this.
    void finish();

    /// finish(), then puts the file under its name, replacing one that is there.
    void commit();

    const std::filesystem::path& target() const { return target_; }

private:
    struct Pending;
    friend void discard_pending_files() noexcept;
    [[noreturn]] void fail(int error_number, std::string_view remedy = {}) const;
    void open_beside_target();
    void flush();
    void write_all(const char* bytes, std::size_t count);
    void discard() noexcept;

    std::filesystem::path target_;
    std::filesystem::path final_;  ///< the target with symbolic links followed
    Pending* pending_ = nullptr;   ///< the temporary name; null when the target is written directly
    std::string buffer_;
    int descriptor_ = -1;
    bool durable_ = true;
};

/// Where a chain of symbolic links ends, whether that exists or not; still a link when it is a loop.
std::filesystem::path follow_links(std::filesystem::path path);

/// Removes the temporary files of all AtomicFiles that are not committed, and of all that are made from now on. To be
/// called from a signal handler that ends the program: it takes no lock and allocates nothing.
void discard_pending_files() noexcept;

}  // namespace ribvault
