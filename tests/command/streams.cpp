// Standard input, output and error: reading from them, and what happens if they are closed, full or disconnected.
#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "command.hpp"

namespace test_streams {

using namespace phasetree::tests;

namespace {

const std::string without_camera =
    R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}, "a,\"b\"": {"diffuse": {"color": [1, 1, 1]}}},
    "tree": {"set": {"phase": "a,\"b\"", "of": {"sphere": {"radius": 1}}}}})";

// A place of a standard stream: nobody who reads, a full disk, or nothing at all.
enum class Place { broken_pipe, full, closed };

void put(int descriptor, Place place) {
    if (place == Place::closed) ::close(descriptor);
    if (place == Place::full) ::dup2(::open("/dev/full", O_WRONLY), descriptor);
    int ends[2];
    if (place == Place::broken_pipe && ::pipe(ends) == 0) {
        ::dup2(ends[1], descriptor);
        ::close(ends[0]);
        ::close(ends[1]);
    }
}

}  // namespace

TEST_CASE("standard output that cannot be written is an error, and the reader who went away is none to speak of") {
    for (const Place place : {Place::broken_pipe, Place::full, Place::closed}) {
        Shell shell;
        write_text(shell.directory / "scene.json", SceneText().text());
        write_text(shell.directory / "tree.json", without_camera);
        shell.in_child = [&] { put(STDOUT_FILENO, place); };
        for (const std::vector<std::string>& words : {std::vector<std::string>{"info", "scene.json"},
                                                      {"info", "scene.json", "--json"},
                                                      {"nodes"},
                                                      {"eval", "scene.json"},
                                                      {"trace", "scene.json"},
                                                      {"check", "tree.json"},
                                                      {"--help"},
                                                      {"--version"}}) {
            CAPTURE(words);
            const Outcome o = shell.run(words, words[0] == "eval" ? "0 0 0\n" : "0 0 0 1 0 0\n");
            CHECK(o.signal == 0);
            CHECK(o.code == 1);
            const bool is_said = o.err.find("cannot write standard output") != std::string::npos;
            CHECK(is_said == (place != Place::broken_pipe));
        }
    }
}

TEST_CASE("endless input ends when nobody reads the output") {
    Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    // Lines from a pipe that a child fills for ever.
    shell.in_child = [] {
        put(STDOUT_FILENO, Place::broken_pipe);
        int ends[2];
        if (::pipe(ends) != 0) return;
        if (::fork() == 0) {
            std::signal(SIGPIPE, SIG_DFL);
            ::close(ends[0]);
            while (::write(ends[1], "0 0 0\n", 6) > 0) continue;
            ::_exit(0);
        }
        ::dup2(ends[0], STDIN_FILENO);
        ::close(ends[0]);
        ::close(ends[1]);
    };
    const Outcome o = shell.run({"eval", "scene.json"});
    CHECK(o.code == 1);
    CHECK(o.signal == 0);
    CHECK(o.err == "");
}

TEST_CASE("a render is not lost with standard error, and no message gets into a picture") {
    const Shell plain;
    write_text(plain.directory / "scene.json", SceneText().text());
    REQUIRE(plain.run({"render", "scene.json", "-o", "a.png", "-o", "b.exr"}).code == 0);
    for (const Place place : {Place::broken_pipe, Place::full, Place::closed}) {
        Shell shell;
        write_text(shell.directory / "scene.json", SceneText().text());
        shell.in_child = [&] { put(STDERR_FILENO, place); };
        const Outcome o = shell.run({"render", "scene.json", "-o", "a.png", "-o", "b.exr"});
        CHECK(o.code == 0);
        CHECK(o.signal == 0);
        for (const char* const image : {"a.png", "b.exr"}) {
            const bool same = bytes_of(shell.directory / image) == bytes_of(plain.directory / image);
            CHECK(same);
        }
        CHECK(shell.directory.size() == 3);
        // Errors still have their exit code.
        CHECK(shell.run({"render", "nowhere.json"}).code == 2);
    }
}

TEST_CASE("all three closed: no file gets their numbers") {
    Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    shell.in_child = [] {
        for (const int descriptor : {0, 1, 2}) ::close(descriptor);
    };
    CHECK(shell.run({"render", "scene.json", "-o", "a.png"}).code == 0);
    const std::string png = bytes_of(shell.directory / "a.png");
    CHECK(png.substr(1, 3) == "PNG");
    CHECK(png.find("Progress") == std::string::npos);
}

TEST_CASE("a scene from standard input") {
    const Shell shell;
    const std::string text = SceneText().text();
    write_text(shell.directory / "scene.json", text);
    const Outcome from_file = shell.run({"info", "--json", "scene.json"});
    for (const char* const name : {"-", "/dev/stdin"}) {
        CAPTURE(name);
        CHECK(shell.run({"check", name}, text).code == 0);
        std::string info = shell.run({"info", "--json", name}, text).out;
        info.replace(info.find("<stdin>"), 7, "scene.json");
        CHECK(info == from_file.out);
        const Outcome wrong = shell.run({"check", name}, "{\"version\": 3,\n\"camera\": 1}");
        CHECK(wrong.code == 2);
        CHECK(wrong.err.find("<stdin>:1:13: ") == 0);
        // Points and rays come from there.
        for (const char* const command : {"eval", "trace"}) {
            const Outcome o = shell.run({command, name}, text);
            CHECK(o.code == 2);
            CHECK(o.err.find("<stdin>: the scene must be a file") == 0);
        }
    }
    CHECK(shell.run({"render", "-", "--quiet"}, text).code == 0);
    CHECK(std::filesystem::exists(shell.directory / "scene.exr"));
    CHECK(std::filesystem::exists(shell.directory / "scene.png"));
}

TEST_CASE("eval reads what it writes, and any CSV with the columns it needs") {
    const Shell shell;
    write_text(shell.directory / "tree.json", without_camera);
    const Outcome first =
        shell.run({"eval", "tree.json"}, "0 0 0\n0.5, 0.25,-3 # far below\n\t\n# nothing\n2\t0 0\r\n");
    REQUIRE(first.code == 0);
    CHECK(first.out ==
          "x,y,z,phase,phi.vacuum,phi.glass,\"phi.a,\"\"b\"\"\"\n"
          "0,0,0,\"a,\"\"b\"\"\",1,,-1\n"
          "0.5,0.25,-3,vacuum,-2.0516388,,2.0516388\n"
          "2,0,0,vacuum,-1,,1\n");
    const Outcome second = shell.run({"eval", "tree.json"}, first.out);
    CHECK(second.code == 0);
    CHECK(second.out == first.out);
    const Outcome other =
        shell.run({"eval", "tree.json"}, "# by hand\nname, z ,\"y\",x\n\"p,1\",-3,0.25, 0.5\n\n,0,0,2\n");
    CHECK(other.code == 0);
    CHECK(other.out.substr(other.out.find("0.5")) == first.out.substr(first.out.find("0.5")));
    const Outcome rays = shell.run({"trace", "tree.json"}, "oz,ox,oy,dx,dy,dz\n5,0,0,0,0,-1\n");
    CHECK(rays.code == 0);
    CHECK(std::count(rays.out.begin(), rays.out.end(), '\n') == 4);

    struct Wrong {
        const char *command, *text, *error;
    };
    for (const Wrong& w :
         {Wrong{"eval", "x,y\n1,2\n", "<stdin>:1:1: the header lacks the column \"z\"; it must name x, y, z\n"},
          Wrong{"trace", "x,y,z\n",
                "<stdin>:1:1: the header lacks the column \"ox\"; it must name ox, oy, oz, dx, dy, dz\n"},
          Wrong{"eval", "\nx,y,z\n1,2\n", "<stdin>:3:4: the row has no z\n"},
          Wrong{"eval", "x,y,z\n1,2x,3\n", "<stdin>:2:3: y must be a finite number, but is \"2x\"\n"},
          Wrong{"eval", "0 0 0\nx,y,z\n", "<stdin>:2:1: expected 3 finite numbers"},
          Wrong{"eval", "1,,2,3\n", "<stdin>:1:3: expected 3 finite numbers"},
          Wrong{"eval", "1,2,3,\n", "<stdin>:1:7: more than 3 numbers"},
          Wrong{"eval", "1-2 3\n", "<stdin>:1:1: expected 3 finite numbers"},
          Wrong{"eval", "1 2 # 3\n", "<stdin>:1:5: expected 3 finite numbers"}}) {
        CAPTURE(w.text);
        const Outcome o = shell.run({w.command, "tree.json"}, w.text);
        CHECK(o.code == 2);
        CHECK(o.err.find(w.error) == 0);
    }
}

TEST_CASE("trace says where each ray starts, so that one from inside is told from one that meets nothing") {
    const Shell shell;
    SceneText scene;
    scene.tree = R"({"thin_shell": {"of": "ball", "shell": "glass", "inside": "water", "half_thickness": 0.1}})";
    write_text(shell.directory / "scene.json", scene.text());
    const Outcome o = shell.run({"trace", "scene.json"}, "5 0 0 1 0 0\n0 0 0 0 0 2\n");
    REQUIRE(o.code == 0);
    CHECK(std::regex_match(o.out, std::regex("ray,t,from,to,nx,ny,nz\n"
                                             "0,0,,vacuum,,,\n"
                                             "1,0,,water,,,\n"
                                             "1,0\\.4[0-9]*,water,glass,0,0,1\n"
                                             "1,0\\.5[0-9]*,glass,vacuum,0,0,1\n")));
}

TEST_CASE("no number is written as minus zero") {
    const Shell shell;
    SceneText scene;
    scene.tree =
        R"({"set": {"phase": "glass", "of": {"translate": {"by": [1, 1, 1], "of": {"box": {"size": [2, 2, 2]}}}}}})";
    write_text(shell.directory / "scene.json", scene.text());
    const std::regex minus_zero("(^|[^0-9.e])-0([^0-9.]|$)");
    std::string points, rays;
    for (const char* const x : {"-0", "0", "1", "2", "-0.0"})
        for (const char* const y : {"-0", "1", "2"}) {
            points += fmt::format("{} {} -0\n", x, y);
            rays += fmt::format("{} {} -3 -0 -0 1\n{} {} 5 0 -0 -1\n-3 {} 1 1 -0 -0\n", x, y, x, y, y);
        }
    for (const std::string& out :
         {shell.run({"eval", "scene.json"}, points).out, shell.run({"trace", "scene.json"}, rays).out,
          shell.run({"info", "scene.json"}).out, shell.run({"info", "--json", "scene.json"}).out}) {
        CHECK(out.size() > 20);
        CHECK_FALSE(std::regex_search(out, minus_zero));
    }
}

}  // namespace test_streams
