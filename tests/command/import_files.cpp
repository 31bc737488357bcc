// `phasetree import`: which files it writes, and that errors leave none.
#include <map>

#include "imports.hpp"

namespace test_import_files {

using namespace phasetree::tests;
using namespace phasetree::tests::imports;

TEST_CASE("nothing is replaced without --force, and errors leave no file") {
    Import shell;
    const Gltf g = drink();
    const auto refused = [&](const std::vector<std::string>& words, const std::string& said, int code = 2) {
        const Outcome o = shell.run(words);
        CAPTURE(o.err);
        CHECK(o.code == code);
        CHECK(has(o.err, said));
        CHECK(o.err.size() < 400);
    };
    write_text(shell.directory / "in.glb", g.file());
    refused({"import", "in.glb"}, "--output is required");
    refused({"import", "in.glb", "-o", "in.glb"}, "must end in .json");
    refused({"import", "in.obj", "-o", "out.json"}, "must end in .glb or .gltf");
    refused({"import", "none.glb", "-o", "out.json"}, "no such file none.glb");
    refused({"import", "in.glb", "-o", "nowhere/out.json"}, "nowhere", 1);
    write_text(shell.directory / "short.glb", g.file().substr(0, 900));
    refused({"import", "short.glb", "-o", "out.json"}, "short.glb: the file ends too early");
    CHECK(shell.entries() == 2);
    // As a full disk: there is room for small meshes, and for no larger one.
    shell.in_child = [] {
        const rlimit limit{900, 900};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    refused({"import", "in.glb", "-o", "out.json"}, "File too large", 1);
    shell.in_child = {};
    CHECK(shell.entries() == 2);
    CHECK(shell.import(g).code == 0);
    const std::string before = bytes_of(shell.directory / "out.json");
    refused({"import", "in.glb", "-o", "out.json"},
            "out.json exists; choose another name with --output, or replace it "
            "with --force");
    fs::remove(shell.directory / "out.json");
    refused({"import", "in.glb", "-o", "out.json"}, "out.meshes/Drink.ply exists");
    CHECK(shell.import(g, {"--force"}).code == 0);
    CHECK(bytes_of(shell.directory / "out.json") == before);
    // A scene in another folder finds everything.
    fs::create_directory(shell.directory / "there");
    CHECK(shell.run({"import", "in.glb", "-o", "there/out.json"}).code == 0);
    CHECK(shell.run({"check", "there/out.json"}).err == "");
}

TEST_CASE("a failed import with --force leaves the old scene and its meshes unchanged, and no new file") {
    Import shell;
    CHECK(shell.import(drink()).code == 0);
    const auto contents = [&] {
        std::map<std::string, std::string> all;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(shell.directory.path()))
            if (entry.is_regular_file()) all.emplace(entry.path().string(), bytes_of(entry.path()));
        return all;
    };
    Gltf changed = drink();
    changed.json["nodes"][1]["scale"] = {0.9, 0.9, 0.9};  // the water, whose mesh changes
    const std::size_t glass = changed.clear("more glass", 1.5f);
    changed.node("A new one", changed.mesh(box({1, 0, 0}, {2, 1, 1}), glass));
    Surface large;
    for (int i = 0; i < 20; ++i) {
        const Surface one = box({5, static_cast<float>(2 * i), 0}, {6, static_cast<float>(2 * i + 1), 1});
        const auto first = static_cast<std::uint32_t>(large.places.size() / 3);
        large.places.insert(large.places.end(), one.places.begin(), one.places.end());
        for (const std::uint32_t t : one.triangles) large.triangles.push_back(first + t);
    }
    changed.node("Too large", changed.mesh(large, glass));
    write_text(shell.directory / "in.glb", changed.file());
    const auto before = contents();
    shell.in_child = [] {
        const rlimit limit{3000, 3000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    const Outcome o = shell.run({"import", "in.glb", "-o", "out.json", "--force"});
    CHECK(o.code == 1);
    CHECK(has(o.err, "Too_large.ply\": File too large"));
    const bool is_unchanged = contents() == before;
    CHECK(is_unchanged);
    shell.in_child = {};
    CHECK(shell.run({"import", "in.glb", "-o", "out.json", "--force"}).code == 0);
    CHECK(fs::exists(shell.directory / "out.meshes/A_new_one.ply"));
}

TEST_CASE("a name that is not UTF-8 is rejected wherever it would be written into JSON") {
    const Import shell;
    const std::string name = "caf\xe9";
    write_text(shell.directory / (name + ".glb"), drink().file());
    write_text(shell.directory / "in.glb", drink().file());
    CHECK(shell.run({"import", "in.glb", "-o", "out.json"}).code == 0);
    fs::copy_file(shell.directory / "out.json", shell.directory / (name + ".json"));
    const std::size_t entries = shell.entries();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"import", name + ".glb", "-o", "new.json"},
          {"import", "in.glb", "-o", name + "2.json"},
          {"info", name + ".json", "--json"},
          {"render", name + ".json", "--size", "4x3", "--spp", "1", "-o", "a.png", "--stats", "s.json"}}) {
        const Outcome o = shell.run(words);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.starts_with("phasetree: the name \"caf\xEF\xBF\xBD"));
        CHECK(has(o.err, "\" is not UTF-8, so it cannot be written into a JSON file; rename the file\n"));
        CHECK(o.out == "");
    }
    CHECK(shell.entries() == entries);
    CHECK(shell.run({"info", name + ".json"}).code == 0);
}

TEST_CASE("a scene behind a symbolic link has its meshes beside it, or is rejected") {
    const Import shell;
    write_text(shell.directory / "in.glb", drink().file());
    fs::create_directory(shell.directory / "there");
    fs::create_symlink("there/scene.json", shell.directory / "link.json");
    const std::size_t entries = shell.entries();
    const Outcome o = shell.run({"import", "in.glb", "-o", "link.json"});
    CHECK(o.code == 2);
    CHECK(o.err ==
          "phasetree: --output: link.json is a symbolic link to another folder, where the scene would not find its "
          "files; give the path of the scene itself, there/scene.json\n");
    CHECK(shell.entries() == entries);
    CHECK(fs::is_empty(shell.directory / "there"));
    fs::create_symlink("scene.json", shell.directory / "same.json");
    CHECK(shell.run({"import", "in.glb", "-o", "same.json"}).code == 0);
    CHECK(fs::is_symlink(shell.directory / "same.json"));
    for (const char* const scene : {"same.json", "scene.json"}) CHECK(shell.run({"check", scene}).err == "");
}

TEST_CASE("clear objects that floats cannot trace are rejected when they are imported") {
    const Import shell;
    const auto with_box = [&](float size) {
        Gltf g;
        g.node("a", g.mesh(box({0, 0, 0}, {size, size, size}), g.clear("glass", 1.5f)));
        return g;
    };
    const Outcome o = shell.import(with_box(1e-20f));
    CAPTURE(o.err);
    CHECK(o.code == 2);
    CHECK(has(o.err, "in.glb: its clear objects are beyond what 32-bit floats can trace: their diagonal is 1.7e-20 m"));
    CHECK(shell.entries() == 1);
    (void)shell.import_well(with_box(1e-10f));
    // Beside a large object, a tiny one does no harm.
    Gltf both = with_box(1e-20f);
    both.node("b", both.mesh(box({0, 0, 0}, {1, 1, 1}), both.clear("ice", 1.31f)));
    (void)shell.import_well(both);
}

TEST_CASE("Ctrl-C ends an import, and no file is left") {
    const Import shell;
    Gltf g;
    Surface many;
    for (int i = 0; i < 20'000; ++i) {
        const auto x = static_cast<float>(2 * i);
        const Surface one = box({x, 0, 0}, {x + 1, 1, 1});
        const auto first = static_cast<std::uint32_t>(many.places.size() / 3);
        many.places.insert(many.places.end(), one.places.begin(), one.places.end());
        for (const std::uint32_t t : one.triangles) many.triangles.push_back(first + t);
    }
    g.node("many", g.mesh(many, g.clear("glass", 1.5f)));
    write_text(shell.directory / "in.glb", g.file());
    bool is_sent = false;
    const Outcome o = shell.run({"import", "in.glb", "-o", "out.json"}, "", [&](pid_t process) {
        if (!is_sent && catches(process, SIGUSR1) && catches(process, SIGINT)) is_sent = ::kill(process, SIGINT) == 0;
    });
    CHECK(o.code == 130);
    CHECK(o.err == "phasetree: interrupted while importing; no file was written\n");
    CHECK(shell.entries() == 1);
}

}  // namespace test_import_files
