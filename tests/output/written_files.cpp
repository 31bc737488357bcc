// What becomes of files: names, permissions, full disks, and that a file is written whole or not at all.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "environment.hpp"
#include "output/file.hpp"
#include "output/write.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "phasetree_support/whole_file.hpp"
#include "pictures.hpp"

namespace test_written_files {

namespace fs = std::filesystem;
using namespace phasetree::tracer;
using namespace phasetree::support;
using namespace phasetree::tracer::test;

namespace {

// While this lives, no file that the process writes can grow beyond this many bytes. It replaces a full disk.
class FileSizeLimit {
  public:
    // The signal is ignored, so that writing fails with an error instead of ending the process.
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        REQUIRE(getrlimit(RLIMIT_FSIZE, &previous_) == 0);
        const rlimit tight{bytes, previous_.rlim_max};
        REQUIRE(setrlimit(RLIMIT_FSIZE, &tight) == 0);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &previous_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    void (*handler_)(int);
    rlimit previous_{};
};

constexpr rlim_t bytes_left = 512;  // fewer than any of the files here has

// The current directory is another one while this lives.
class CurrentDirectory {
  public:
    explicit CurrentDirectory(const fs::path& folder) : previous_(fs::current_path()) { fs::current_path(folder); }
    ~CurrentDirectory() { fs::current_path(previous_); }
    CurrentDirectory(const CurrentDirectory&) = delete;
    CurrentDirectory& operator=(const CurrentDirectory&) = delete;

  private:
    fs::path previous_;
};

}  // namespace

TEST_CASE("a bad name is rejected with the reason, before and after rendering") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    fs::create_directory(folder / "folder.png");
    write_text(folder / "file", "");
    fs::create_symlink("loop.png", folder / "loop.png");
    const Image image = noise(8, 8);
    const DisplayTransform transform;
    struct Case {
        fs::path path;
        const char* reason;
    };
    const Case cases[] = {
        {folder / "a.bmp", "unknown image format \".bmp\"; use .exr, .png, .jpg, .jpeg, .tif or .tiff"},
        {folder / "a", "its name has no extension; use .exr"},
        {folder / ".exr", "its name has no extension"},
        {"", "its name has no extension"},
        {folder / "folder.png", "it is a directory"},
        {folder / "missing" / "a.png", "no such directory"},
        {folder / "file" / "a.png", "is not a directory"},
        {folder / (std::string(300, 'x') + ".png"), "File name too long"},
        {folder / "loop.png", "the symbolic link points to itself"},
        {"/proc/a.png", "cannot create a file in the directory \"/proc\""},  // not even by root
    };
    for (const Case& c : cases) {
        CAPTURE(c.path.string());
        const std::string before = message_of<OutputError>([&] { check_writable(c.path); });
        const std::string after = message_of<OutputError>([&] { write_image(image, c.path, metadata, transform); });
        CHECK(contains(before, c.reason));
        CHECK(before == after);
        CHECK(contains(before, "cannot write \"" + c.path.string() + "\": "));
        CHECK_FALSE(contains(before, "\n"));
    }
    CHECK(folder.size() == 3);
}

TEST_CASE("permissions are respected") {
    const TemporaryDirectory folder;
    write_text(folder / "protected.png", "precious");
    fs::permissions(folder / "protected.png", fs::perms(0444));
    // Root may write everywhere, so as root the test acts as the user "nobody" for a moment.
    constexpr uid_t nobody = 65534;
    const bool root = ::geteuid() == 0;
    for (const bool writable_folder : {false, true}) {
        fs::permissions(folder.path(), fs::perms(writable_folder ? 0777 : 0555));
        if (root && ::seteuid(nobody) != 0) {
            MESSAGE("not tested: root cannot act as another user here");
            continue;
        }
        const std::string created = message_of<OutputError>([&] { check_writable(folder / "a.png"); });
        const std::string replaced = message_of<OutputError>([&] { check_writable(folder / "protected.png"); });
        if (root) REQUIRE(::seteuid(0) == 0);
        CHECK(contains(created, writable_folder ? "(no exception)" : "Permission denied"));
        CHECK(contains(replaced, "Permission denied"));
    }
    fs::permissions(folder.path(), fs::perms(0755));
    CHECK(bytes_of(folder / "protected.png") == "precious");
    CHECK(folder.size() == 1);
}

TEST_CASE("a full disk leaves the old file and no other") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const Image image = noise(64, 64);
    const DisplayTransform transform;
    for (const char* name : names) {
        CAPTURE(name);
        write_text(folder / name, "precious");
        std::string message;
        {
            const FileSizeLimit full(bytes_left);
            message = message_of<OutputError>([&] { write_image(image, folder / name, metadata, transform); });
        }
        CHECK(contains(message, "File too large"));
        CHECK(contains(message, name));
        CHECK(bytes_of(folder / name) == "precious");
    }
    CHECK(folder.size() == names.size());
}

TEST_CASE("a file of any kind is written whole or not at all, and never instead of what is no file") {
    const TemporaryDirectory folder;
    write_text(folder / "numbers", "precious");
    std::string message;
    {
        const FileSizeLimit full(bytes_left);
        message = message_of<OutputError>([&] { write_file(std::string(1000, '1'), folder / "numbers"); });
    }
    CHECK(contains(message, "File too large"));
    CHECK(bytes_of(folder / "numbers") == "precious");
    write_file("one two", folder / "numbers");
    CHECK(bytes_of(folder / "numbers") == "one two");
    write_file("", folder / "numbers");
    CHECK(bytes_of(folder / "numbers") == "");

    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    fs::create_symlink("pipe", folder / "link");
    for (const char* name : {"pipe", "link"}) {
        CAPTURE(name);
        const std::string before = message_of<OutputError>([&] { check_file_writable(folder / name); });
        const std::string after = message_of<OutputError>([&] { write_file("one", folder / name); });
        CHECK(contains(before, "it is not a regular file"));
        CHECK(contains(after, "it is not a regular file"));
    }
    CHECK(fs::is_fifo(folder / "pipe"));
    CHECK(folder.size() == 3);
}

TEST_CASE("writing replaces the old file, and only it") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    write_text(folder / "target.png", "old");
    fs::create_symlink("target.png", folder / "link.png");
    // Processes that were killed have left half of this file, and half of another one, which stays.
    write_text(folder / ".target.png.1.2.tmp", "half");
    write_text(folder / ".other.png.1.2.tmp", "half");
    check_writable(folder / "link.png");
    CHECK(bytes_of(folder / "target.png") == "old");
    write_image(noise(8, 8), folder / "link.png", metadata, DisplayTransform());
    CHECK(fs::is_symlink(folder / "link.png"));
    CHECK(bytes_of(folder / "target.png").substr(1, 3) == "PNG");
    CHECK(bytes_of(folder / ".other.png.1.2.tmp") == "half");
    CHECK(folder.size() == 3);

    check_writable(folder / "new.exr");
    CHECK(folder.size() == 3);

    {
        const CurrentDirectory here(folder.path());
        write_image(noise(8, 8), "bare.exr", metadata, DisplayTransform());
    }
    CHECK(fs::is_regular_file(folder / "bare.exr"));
    CHECK(folder.size() == 4);
}

}  // namespace test_written_files
