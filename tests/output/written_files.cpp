// What becomes of files: names, permissions, full disks, and that a file is written whole or not at all.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

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

/// No file of this process may grow beyond a few bytes: the nearest to a full disk that needs no disk.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &previous_);
        const rlimit tight{bytes, previous_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &tight);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &previous_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    void (*handler_)(int);
    rlimit previous_{};
};

}  // namespace

TEST_CASE("a bad name is refused with the reason, before and after rendering") {
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
        {folder / "a.bmp",
         "\".bmp\" is no known image format; the formats are .exr, .png, .jpg, .jpeg, .tif and .tiff"},
        {folder / "a", "its name has no extension; the formats are .exr"},
        {folder / ".exr", "its name has no extension"},
        {"", "its name has no extension"},
        {folder / "folder.png", "it is a directory"},
        {folder / "missing" / "a.png", "there is no directory"},
        {folder / "file" / "a.png", "is not a directory"},
        {folder / (std::string(300, 'x') + ".png"), "File name too long"},
        {folder / "loop.png", "the symbolic link leads nowhere"},
        {"/proc/a.png", "no file can be created in the directory \"/proc\""},  // not even by root
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
    // Root may write everywhere: become somebody else for a moment, where that is possible.
    const bool root = ::geteuid() == 0;
    for (const bool writable_folder : {false, true}) {
        fs::permissions(folder.path(), fs::perms(writable_folder ? 0777 : 0555));
        if (root && ::seteuid(65534) != 0) continue;
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
            const FullDisk full(512);
            message = message_of<OutputError>([&] { write_image(image, folder / name, metadata, transform); });
        }
        CHECK(contains(message, "File too large"));
        CHECK(contains(message, name));
        CHECK(bytes_of(folder / name) == "precious");
    }
    CHECK(folder.size() == names.size());
}

TEST_CASE("a file of any kind is written whole or not at all, and never in the place of what is no file") {
    const TemporaryDirectory folder;
    write_text(folder / "numbers", "precious");
    std::string message;
    {
        const FullDisk full(512);
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
        for (const bool before : {true, false})
            CHECK(contains(message_of<OutputError>(
                               [&] { before ? check_file_writable(folder / name) : write_file("one", folder / name); }),
                           "it is not a regular file"));
    }
    CHECK(fs::is_fifo(folder / "pipe"));
    CHECK(folder.size() == 3);
}

namespace {

// The temporary name that the next file will have: what a killed process of the same number may have left. It is that
// of a file that is begun now, and its number the next.
std::string next_temporary(const fs::path& folder, const std::string& name) {
    const WholeFile begun(folder / name);
    const std::string before = "." + name + "." + std::to_string(::getpid()) + ".";
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string now = entry.path().filename().string();
        if (now.starts_with(before)) return before + std::to_string(std::stoi(now.substr(before.size())) + 1) + ".tmp";
    }
    throw std::logic_error("no temporary file");
}

}  // namespace

TEST_CASE("writing replaces the old file, and only it") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    write_text(folder / "target.png", "old");
    fs::create_symlink("target.png", folder / "link.png");
    write_text(folder / next_temporary(folder.path(), "target.png"), "half");
    check_writable(folder / "link.png");
    CHECK(bytes_of(folder / "target.png") == "old");
    write_image(noise(8, 8), folder / "link.png", metadata, DisplayTransform());
    CHECK(fs::is_symlink(folder / "link.png"));
    CHECK(bytes_of(folder / "target.png").substr(1, 3) == "PNG");
    CHECK(folder.size() == 2);

    check_writable(folder / "new.exr");
    CHECK(folder.size() == 2);

    const fs::path here = fs::current_path();
    fs::current_path(folder.path());
    write_image(noise(8, 8), "bare.exr", metadata, DisplayTransform());
    fs::current_path(here);
    CHECK(fs::is_regular_file(folder / "bare.exr"));
    CHECK(folder.size() == 3);
}

}  // namespace test_written_files
