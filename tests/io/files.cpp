// Errors say plainly why something is not a readable scene file, and reading never waits for a pipe.

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "phasetree/io/document.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace test_files {

using phasetree::Document;
using phasetree::SceneError;
namespace fs = std::filesystem;

namespace {

// Open to all, because another user reads it, too.
class Folder : public phasetree::support::TemporaryDirectory {
  public:
    Folder() { fs::permissions(path(), fs::perms::all); }
};

std::string told(const fs::path& path) {
    try {
        Document::from_file(path);
    } catch (const SceneError& error) {
        CHECK(error.line() == 0);
        CHECK(error.column() == 0);
        return error.what();
    }
    return "was accepted";
}

// A privileged user may read everything, so become another user for a while.
class Unprivileged {
  public:
    Unprivileged() : was_root_(::geteuid() == 0) {
        if (was_root_) is_other_ = ::seteuid(65534) == 0;
    }
    ~Unprivileged() {
        if (is_other_ && ::seteuid(0) != 0) std::abort();
    }
    Unprivileged(const Unprivileged&) = delete;
    Unprivileged& operator=(const Unprivileged&) = delete;

    bool works() const { return !was_root_ || is_other_; }

  private:
    bool was_root_;
    bool is_other_ = false;
};

}  // namespace

TEST_CASE("a file is read, and its name is in its errors") {
    const Folder folder;
    const fs::path path = folder / "scene.json";
    std::ofstream(path, std::ios::binary) << "{\"a\": [1, 2, 3]}\r\n";
    const Document document = Document::from_file(path);
    CHECK(document.name() == path.string());
    CHECK(document.text() == "{\"a\": [1, 2, 3]}\r\n");
    CHECK(document.root().find("a")->size() == 3);
    CHECK(std::string(document.error(*document.root().find("a"), "wrong").what()) ==
          path.string() + ":1:7: wrong\n  {\"a\": [1, 2, 3]}\n        ^");
}

TEST_CASE("an empty file is told with its position") {
    const Folder folder;
    const fs::path path = folder / "empty.json";
    std::ofstream(path, std::ios::binary).flush();
    CHECK_THROWS_WITH_AS(Document::from_file(path), (path.string() + ":1:1: the file is empty\n  \n  ^").c_str(),
                         SceneError);
}

TEST_CASE("missing, directory, pipe, device") {
    const Folder folder;
    CHECK(told("") == "(no name): the name of a file is empty");
    const std::string missing = (folder / "scnee.json").string();
    CHECK(told(missing) == missing + ": no such file");
    const std::string meant = (folder / "scene.json").string();
    std::ofstream(meant, std::ios::binary) << "{}";
    CHECK(told(missing) == missing + ": no such file (did you mean \"" + meant + "\"?)");
    CHECK(told(meant + "/scene.json") == meant + "/scene.json: no such file");
    CHECK(told(fs::temp_directory_path()) == fs::temp_directory_path().string() + ": is a directory, not a file");
    CHECK(told(std::string("a\0b", 3)).starts_with("a␀b: no such file"));
    const std::string long_name(5000, 'x');
    CHECK(told(long_name).find("cannot be read: File name too long") != std::string::npos);

    const std::string pipe = (folder / "pipe").string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(told(pipe) == pipe + ": is not a regular file but a pipe, a socket or a device");
    CHECK(told("/dev/zero") == "/dev/zero: is not a regular file but a pipe, a socket or a device");
    CHECK(told("/dev/tty") == "/dev/tty: is not a regular file but a pipe, a socket or a device");

    const fs::path loop = folder / "loop";
    fs::create_symlink(loop, loop);
    CHECK(told(loop).find("loop: cannot be read: ") != std::string::npos);
    const fs::path link = folder / "link";
    fs::create_symlink(meant, link);
    CHECK_NOTHROW(Document::from_file(link));
}

TEST_CASE("no permission") {
    const Folder folder;
    const std::string path = (folder / "secret.json").string();
    std::ofstream(path, std::ios::binary) << "{}";
    fs::permissions(path, fs::perms::none);
    const Unprivileged other;
    if (!other.works()) {
        MESSAGE("cannot give up privileges here");
        return;
    }
    CHECK(told(path) == path + ": no permission to read the file");
}

TEST_CASE("larger than the limit") {
    const Folder folder;
    const std::string path = (folder / "large.json").string();
    std::ofstream(path, std::ios::binary).flush();
    fs::resize_file(path, Document::max_bytes + 1);  // sparse
    CHECK(told(path) == path + ": is larger than 256 MiB");
}

}  // namespace test_files
