// Files appear complete or not at all, and every failure is told.
#include "ribvault/output_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <sstream>

#include "report/scratch_folder.hpp"
#include "ribvault/error.hpp"

using namespace ribvault;
using test::ScratchFolder;
namespace fs = std::filesystem;

namespace {

/// The message of the Error that `work` throws; fails the test when it throws none or one of another kind.
template <class Work>
std::string refusal(Work&& work) {
    try {
        work();
    } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::cannot_write);
        return e.what();
    }
    FAIL("no error");
    return {};
}

}  // namespace

TEST_CASE("a committed file has exactly what was written, in small and large pieces") {
    const ScratchFolder folder;
    const std::string large(200000, 'x');
    std::string expected;
    AtomicFile file(folder / "a.txt");
    for (int k = 0; k < 5000; ++k) {
        const std::string piece = std::to_string(k) + "\n";
        file.write(piece);
        expected += piece;
        if (k % 2000 == 1999) file.write(large), expected += large;
    }
    file.overwrite(2, "??");
    expected.replace(2, 2, "??");
    file.write("end");
    expected += "end";
    CHECK_FALSE(fs::exists(folder / "a.txt"));
    file.finish();
    CHECK_FALSE(fs::exists(folder / "a.txt"));
    file.commit();
    CHECK(test::contents(folder / "a.txt") == expected);
    CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("a file that is not committed leaves nothing, and what was there stays") {
    const ScratchFolder folder;
    std::ofstream(folder / "old.txt") << "old";
    for (const bool finished : {false, true}) {
        AtomicFile over(folder / "old.txt"), fresh(folder / "new.txt");
        over.write("new"), fresh.write("new");
        if (finished) over.finish(), fresh.finish();
        CHECK(folder.names().size() == 3);
    }
    CHECK(folder.names() == std::vector<std::string>{"old.txt"});
    CHECK(test::contents(folder / "old.txt") == "old");
}

TEST_CASE("a replaced file keeps its permissions, a new one has the usual ones") {
    const ScratchFolder folder;
    std::ofstream(folder / "old.txt") << "old";
    fs::permissions(folder / "old.txt", fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    const mode_t mask = ::umask(022);
    AtomicFile(folder / "old.txt").commit();
    AtomicFile(folder / "new.txt").commit();
    ::umask(mask);
    CHECK(static_cast<int>(fs::status(folder / "old.txt").permissions()) == 0640);
    CHECK(static_cast<int>(fs::status(folder / "new.txt").permissions()) == 0644);
}

TEST_CASE("a symbolic link stays a link, and its target is written") {
    const ScratchFolder folder;
    fs::create_directory(folder / "there");
    for (const bool dangling : {true, false}) {
        if (dangling) fs::create_symlink("there/real.txt", folder / "link.txt");
        AtomicFile file(folder / "link.txt");
        file.write(dangling ? "first" : "second");
        file.commit();
        CHECK(fs::is_symlink(folder / "link.txt"));
        CHECK(test::contents(folder / "there" / "real.txt") == (dangling ? "first" : "second"));
    }
}

TEST_CASE("names as long as names can be are written") {
    const ScratchFolder folder;
    const fs::path name = folder / std::string(255, 'n');
    AtomicFile(name).commit();
    CHECK(fs::exists(name));
}

TEST_CASE("what cannot be opened is refused with name, reason and remedy") {
    const ScratchFolder folder;
    const std::string missing = refusal([&] { AtomicFile(folder / "no" / "a.txt"); });
    CHECK_THAT(missing,
               Catch::Contains("no/a.txt") && Catch::Contains("No such file") && Catch::Contains("create the folder"));
    CHECK_THAT(refusal([&] { AtomicFile(folder.path()); }), Catch::Contains("Is a directory"));
    CHECK_THAT(refusal([&] { AtomicFile(folder.path().string() + "/"); }), Catch::Contains("Is a directory"));
    std::ofstream(folder / "file") << "";
    CHECK_THAT(refusal([&] { AtomicFile(folder / "file" / "a.txt"); }), Catch::Contains("Not a directory"));
    fs::create_symlink("loop", folder / "loop");
    CHECK_THAT(refusal([&] { AtomicFile(folder / "loop").commit(); }), Catch::Contains("loop"));
    CHECK(folder.names() == std::vector<std::string>{"file", "loop"});
}

TEST_CASE("a read-only file is not replaced") {
    if (::geteuid() == 0) return;  // root may write everything
    const ScratchFolder folder;
    std::ofstream(folder / "a.txt") << "kept";
    fs::permissions(folder / "a.txt", fs::perms::owner_read);
    CHECK_THAT(refusal([&] { AtomicFile(folder / "a.txt"); }), Catch::Contains("Permission denied"));
}

TEST_CASE("a full disk is told, at the latest when the file is finished") {
    AtomicFile small("/dev/full");
    small.write("a few bytes");
    CHECK_THAT(refusal([&] { small.finish(); }), Catch::Contains("/dev/full") && Catch::Contains("No space left"));
    AtomicFile large("/dev/full");
    CHECK_THAT(refusal([&] { large.write(std::string(1 << 20, 'x')); }), Catch::Contains("No space left"));
    CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("a disk that fills up half-way leaves no file") {
    const ScratchFolder folder;
    const auto unlimited = [] {
        rlimit limit{};
        ::getrlimit(RLIMIT_FSIZE, &limit);
        return limit;
    }();
    auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limited = unlimited;
    limited.rlim_cur = 100000;
    ::setrlimit(RLIMIT_FSIZE, &limited);
    std::string message;
    {
        AtomicFile file(folder / "a.txt");
        message = refusal([&] {
            for (int k = 0; k < 100; ++k) file.write(std::string(5000, 'x'));
            file.commit();
        });
    }
    ::setrlimit(RLIMIT_FSIZE, &unlimited);
    std::signal(SIGXFSZ, old_handler);
    CHECK_THAT(message, Catch::Contains("File too large"));
    CHECK(folder.names().empty());
}

TEST_CASE("devices are written directly") {
    AtomicFile null("/dev/null");
    null.write("gone");
    null.commit();
    CHECK(fs::is_character_file("/dev/null"));

    const ScratchFolder folder;
    const fs::path pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(reader >= 0);
    AtomicFile file(pipe);
    file.write("through the pipe");
    CHECK_THAT(refusal([&] { file.overwrite(0, "T"); }), Catch::Contains("Illegal seek"));
    file.commit();
    char text[64];
    const ssize_t count = ::read(reader, text, sizeof text);
    ::close(reader);
    CHECK(std::string(text, static_cast<std::size_t>(std::max<ssize_t>(count, 0))) == "through the pipe");
    CHECK(fs::is_fifo(pipe));
}

TEST_CASE("a signal handler can remove all files that are not committed") {
    const ScratchFolder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        std::signal(SIGTERM, [](int) {
            discard_pending_files();
            ::_exit(42);
        });
        AtomicFile done(folder / "done.txt"), open(folder / "open.txt"), finished(folder / "finished.txt");
        AtomicFile moved_from(folder / "moved.txt"), moved(std::move(moved_from));
        done.write("done"), open.write("open"), finished.write("finished");
        done.commit();
        finished.finish();
        ::raise(SIGTERM);
        ::_exit(1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 42);
    CHECK(folder.names() == std::vector<std::string>{"done.txt"});
}
